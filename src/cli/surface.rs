//! `asperity surface`: what a measured or made surface is, and a scene with it.

mod crests;
mod pictures;

use std::fmt::Write as _;
use std::path::Path;

use asperity_engine::math::number::{length, sig};
use asperity_engine::physics::areal::{self, ArealParameters};
use asperity_engine::physics::kept::kept;
use asperity_engine::scene::{MapEdge, Scene, Surface, presets};

use super::args::{SurfaceArgs, Turn};
use super::failure::Failure;
use super::scenes::print;

/// Prints the parameters, and writes a scene where one is asked for.
pub(crate) fn surface(args: &SurfaceArgs) -> Result<u8, Failure> {
    let name = args.file.to_string_lossy();
    let is_toml = args.file.extension().is_some_and(|ending| ending == "toml");
    let mut text = String::new();
    if is_toml || presets::find(&name).is_some() {
        let scene = Scene::load(&name)?;
        for (body, surface) in (1..).zip(scene.surfaces()) {
            let _ = writeln!(text, "Body {body}");
            tell(&mut text, surface);
            draw(args, &mut text, &format!("body_{body}_"), surface)?;
        }
        crests::tell(&mut text, &scene);
    } else {
        let scene = with_map(args)?;
        tell(&mut text, &scene.body_1.surface);
        draw(args, &mut text, "", &scene.body_1.surface)?;
        if let Some(path) = &args.scene {
            scene.validate()?;
            write_new(path, &scene.to_toml())?;
            let _ = writeln!(text, "scene      {}", path.display());
        }
    }
    print(&text)?;
    Ok(0)
}

/// Draws a surface where pictures are asked for.
fn draw(
    args: &SurfaceArgs,
    text: &mut String,
    prefix: &str,
    surface: &Surface,
) -> Result<(), Failure> {
    if let (Some(folder), Some(heights)) = (&args.pictures, surface.relief_heights_m()) {
        for name in pictures::draw(folder, prefix, &heights)? {
            let _ = writeln!(text, "picture    {name}");
        }
    }
    Ok(())
}

/// The default scene with the file on body 1, and a smooth body 2.
fn with_map(args: &SurfaceArgs) -> Result<Scene, Failure> {
    match args.turn_deg {
        None => turned_map(args, None),
        Some(Turn::Degrees(degrees)) => turned_map(args, Some(degrees)),
        Some(Turn::Lay) => {
            let as_it_lies = turned_map(args, None)?;
            let found = as_it_lies.body_1.surface.relief_heights_m();
            let found = found.and_then(|(nx, z, pixel_m)| areal::parameters(nx, &z, pixel_m));
            match found.and_then(|found| found.lay_deg) {
                // As it is printed: a scene holds no digits that nobody measured.
                Some(lay) => turned_map(args, Some(-(10.0 * lay).round() / 10.0)),
                None => Ok(as_it_lies),
            }
        }
    }
}

/// With the map turned so.
fn turned_map(args: &SurfaceArgs, turn_deg: Option<f64>) -> Result<Scene, Failure> {
    let mut scene = Scene::load(presets::DEFAULT)?;
    "A measured surface on a smooth one".clone_into(&mut scene.title);
    scene.about = format!(
        "The operating point of {} with a measured surface on body 1: set your own.",
        presets::DEFAULT
    );
    scene.body_2.surface = Surface::Smooth {};
    scene.body_1.surface = Surface::HeightMap {
        file: args.file.to_string_lossy().into_owned(),
        pixel_m: args.pixel_m,
        edge: MapEdge::Periodic,
        unit_m: args.unit_m,
        level: Some(args.level()),
        outliers: args.outliers(),
        amplitude_m: None,
        crop_m: args.crop_m,
        turn_deg,
        s_filter_m: args.s_filter_m,
        l_filter_m: args.l_filter_m,
        start_x_m: None,
        digest: None,
        map: None,
    };
    scene.read_maps(Path::new(""))?;
    Ok(scene)
}

/// What a surface is, in lines.
fn tell(text: &mut String, surface: &Surface) {
    for line in surface.relief_lines() {
        let _ = writeln!(text, "{line}");
    }
    let Some((nx, heights_m, pixel_m)) = surface.relief_heights_m() else {
        let _ = writeln!(text, "no heights of its own: {}\n", surface.kind().key());
        return;
    };
    if let Some(found) = areal::parameters(nx, &heights_m, pixel_m) {
        text.push_str(&parameters(&found));
    }
    let all = kept(nx, &heights_m, pixel_m[0]);
    if !all.is_empty() {
        text.push_str("\nwaves along x of at least   keep of Sq   of the slope along x\n");
    }
    for one in all {
        let _ = writeln!(
            text,
            "{:>24} {:>10} % {:>10} %",
            length(one.wave_m),
            sig(100.0 * one.height, 3),
            sig(100.0 * one.slope, 3)
        );
    }
    text.push('\n');
}

/// The parameters, each with the definition that it uses.
fn parameters(p: &ArealParameters) -> String {
    let known =
        |value: Option<f64>, text: fn(f64) -> String| value.map_or_else(|| "none".to_owned(), text);
    let number = |value: f64| sig(value, 5);
    let degrees = |value: f64| format!("{} degrees", sig(value, 3));
    let rows: [(&str, String, &str); 17] = [
        (
            "Sq",
            microns(p.sq_m),
            "root mean square height (ISO 25178-2)",
        ),
        ("Sa", microns(p.sa_m), "mean of |z|"),
        ("Sp", microns(p.sp_m), "highest point"),
        ("Sv", microns(p.sv_m), "depth of the lowest"),
        ("Sz", microns(p.sz_m), "Sp + Sv"),
        ("Ssk", sig(p.ssk, 5), "skewness"),
        ("Sku", sig(p.sku, 5), "kurtosis"),
        (
            "Sdq",
            number(p.sdq),
            "root mean square slope, central differences",
        ),
        (
            "Sdq'",
            number(p.sdq_forward),
            "the same by forward differences",
        ),
        (
            "Sal",
            known(p.sal_m, microns),
            "shortest way to an autocorrelation of 0.2",
        ),
        (
            "Str",
            known(p.str_ratio, number),
            "Sal over the longest such way; 1: isotropic",
        ),
        (
            "lay",
            known(p.lay_deg, degrees),
            "from x to the direction across the ridges",
        ),
        (
            "Ra",
            microns(p.ra_m),
            "mean over the rows, each by itself (profiles along x)",
        ),
        ("Rq", microns(p.rq_m), "root mean square likewise"),
        (
            "Rz",
            microns(p.rz_m),
            "peak to valley, mean of five sampling lengths",
        ),
        (
            "RSm",
            known(p.rsm_m, microns),
            "mean spacing of profile elements",
        ),
        (
            "Rq/Sq",
            number(p.rq_m / p.sq_m),
            "1 where all height runs along x",
        ),
    ];
    let mut text = String::new();
    for (name, value, what) in rows {
        let _ = writeln!(text, "{name:<6} {value:<14} {what}");
    }
    text
}

/// A length to as many figures as parameters are compared to.
fn microns(value_m: f64) -> String {
    format!("{} µm", sig(1e6 * value_m, 5))
}

/// Writes a file that must not be there yet.
fn write_new(path: &Path, text: &str) -> Result<(), Failure> {
    use std::io::Write as _;
    let failed = |error: std::io::Error| {
        asperity_engine::observe::ObserveError::new(path.display().to_string(), error.to_string())
    };
    let file = std::fs::OpenOptions::new()
        .write(true)
        .create_new(true)
        .open(path);
    let mut file = file.map_err(failed)?;
    file.write_all(text.as_bytes()).map_err(failed)?;
    Ok(())
}
