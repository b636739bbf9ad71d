//! Exported fields: one archive a step with the scene beside it, and nobody's files lost.
#![expect(clippy::unwrap_used, reason = "tests")]

use crate::common::synthetic;
use asperity::observe::{Export, Format, Observer, Overwrite};

const NODES: usize = 17;

#[test]
fn every_step_handed_over_becomes_an_archive_beside_the_scene() {
    let folder = tempfile::tempdir().unwrap();
    let target = folder.path().join("fields");
    let mut export = Export::create(&target, Overwrite::Refuse, &[Format::Npz]).unwrap();
    let context = synthetic::context(synthetic::scene(NODES, 1.0));
    export.begin(&context).unwrap();
    for step in [16, 32] {
        export.frame(&synthetic::frame(NODES, step)).unwrap();
    }
    let report = export.finish().unwrap();
    let bytes = |name: &str| std::fs::read(target.join(name)).unwrap();
    let (one, two) = (bytes("step_000016.npz"), bytes("step_000032.npz"));
    assert_eq!(
        (report.frames, report.bytes),
        (2, (one.len() + two.len()) as u64)
    );
    assert_eq!(bytes("scene.toml"), context.scene_toml.as_bytes());
    // The pressure lies in the file as the frame held it.
    let frame = synthetic::frame(NODES, 16);
    let pressure: Vec<u8> = frame
        .pressure_pa
        .iter()
        .flat_map(|p| p.to_le_bytes())
        .collect();
    assert!(one.windows(pressure.len()).any(|window| window == pressure));
    for name in [
        "pressure_pa.npy",
        "film_m.npy",
        "slice_effective_pa.npy",
        "x_m.npy",
    ] {
        assert!(
            one.windows(name.len())
                .any(|window| window == name.as_bytes()),
            "{name}"
        );
    }
}

#[test]
fn a_folder_with_somebodys_files_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("notes.txt"), "mine").unwrap();
    let refused = Export::create(folder.path(), Overwrite::Refuse, &[Format::Npz]).unwrap_err();
    assert!(refused.reason.contains("--force"), "{refused}");
    assert!(Export::create(folder.path(), Overwrite::Replace, &[Format::Npz]).is_ok());
    let file = folder.path().join("notes.txt");
    assert!(Export::create(&file.join("below"), Overwrite::Refuse, &[Format::Npz]).is_err());
}

#[test]
fn pictures_are_drawn_of_every_map_and_of_the_centre_line() {
    let folder = tempfile::tempdir().unwrap();
    let mut export = Export::create(folder.path(), Overwrite::Refuse, &[Format::Png]).unwrap();
    let context = synthetic::context(synthetic::scene(NODES, 1.0));
    export.begin(&context).unwrap();
    export.frame(&synthetic::frame(NODES, 16)).unwrap();
    let report = export.finish().unwrap();
    let mut bytes = 0;
    for name in [
        "pressure",
        "film",
        "interferogram",
        "traction",
        "roughness_1",
        "roughness_2",
        "effective_stress",
        "tau_xz",
        "centre_line",
    ] {
        let file = folder.path().join(format!("step_000016_{name}.png"));
        let picture = std::fs::read(&file).unwrap();
        assert!(picture.starts_with(b"\x89PNG\r\n"), "{name}");
        // Width and height in the header; the end is there.
        assert!(u32::from_be_bytes(picture[16..20].try_into().unwrap()) > 700);
        assert!(picture.ends_with(b"IEND\xaeB`\x82"), "{name}");
        bytes += picture.len() as u64;
    }
    assert_eq!((report.frames, report.bytes), (1, bytes));
    assert!(!folder.path().join("step_000016.npz").exists());
}
