//! Surfaces as instruments keep them, `.x3p` and `.sur`: one surface in every format, missing points, defects, damage. The
//! bytes are built here from the layouts, by nothing that the reader uses but for zip and zlib.

#![allow(clippy::unwrap_used, reason = "tests")]

use std::fmt::Write as _;
use std::io::{Cursor, Write as _};
use std::path::Path;
use std::time::{Duration, Instant};

use asperity_engine::physics::height_map::FileDefect;
use asperity_engine::scene::{MapReport, Scene, Surface};
use flate2::Compression;
use flate2::write::ZlibEncoder;
use zip::ZipWriter;
use zip::write::SimpleFileOptions;

#[path = "../attack/mutate.rs"]
#[expect(dead_code, reason = "the attack's own")]
mod mutate;

use mutate::Random;

const COLUMNS: usize = 24;
const ROWS: usize = 20;
const PIXEL_M: f64 = 2e-5;
/// Height of a whole number, m.
const STEP_M: f64 = 1e-10;
const OFFSET_M: f64 = 3e-7;

/// Whole numbers of `STEP_M`, unlike under any turning or mirroring.
fn counts() -> Vec<i32> {
    let count = |n: usize| {
        let (i, j) = ((n % COLUMNS) as f64, (n / COLUMNS) as f64);
        (900.0 * (0.55 * i).sin() + 700.0 * (0.31 * j * j).cos() + 90.0 * i - 60.0 * j) as i32
    };
    (0..COLUMNS * ROWS).map(count).collect()
}

fn heights_m() -> Vec<f64> {
    let height = |count: i32| f64::from(count) * STEP_M + OFFSET_M;
    counts().into_iter().map(height).collect()
}

/// What a `.x3p` holds.
#[derive(Clone)]
struct X3p {
    root: &'static str,
    z: &'static str,
    z_step: String,
    step_x: String,
    step_y: String,
    revision: &'static str,
    folder: &'static str,
    link: &'static str,
    data: Vec<u8>,
    /// Instead of a file of points.
    list: Option<String>,
    valid: Option<Vec<u8>>,
    checksum: bool,
    /// What it says; `None`: what it should.
    sum: Option<&'static str>,
    comment: &'static [u8],
}

impl X3p {
    fn new(z: &'static str, data: Vec<u8>) -> Self {
        let is_integer = matches!(z, "I" | "L");
        Self {
            root: "p:ISO5436_2",
            z,
            z_step: if is_integer {
                format!("{STEP_M:e}")
            } else {
                "1".to_owned()
            },
            step_x: format!("{PIXEL_M:e}"),
            step_y: format!("{PIXEL_M:e}"),
            revision: "ISO5436 - 2000",
            folder: "",
            link: "bindata/data.bin",
            data,
            list: None,
            valid: None,
            checksum: true,
            sum: None,
            comment: b"none",
        }
    }

    fn of(z: &'static str) -> Self {
        let whole = counts();
        let offset = if matches!(z, "I" | "L") {
            0.0
        } else {
            OFFSET_M
        };
        let real = heights_m().into_iter().map(|z| z - offset);
        let data = match z {
            "I" => whole
                .iter()
                .flat_map(|&z| (z as i16).to_le_bytes())
                .collect(),
            "L" => whole.iter().flat_map(|z| z.to_le_bytes()).collect(),
            "F" => real.flat_map(|z| (z as f32).to_le_bytes()).collect(),
            _ => real.flat_map(f64::to_le_bytes).collect(),
        };
        Self::new(z, data)
    }

    fn xml(&self) -> Vec<u8> {
        let Self {
            root,
            z,
            z_step,
            step_x,
            step_y,
            revision,
            link,
            ..
        } = self;
        let place = self.list.as_ref().map_or_else(
            || {
                let valid = self.valid.as_ref().map_or(
                    "",
                    |_| "<ValidPointsLink>bindata/valid.bin</ValidPointsLink>",
                );
                format!("<DataLink><PointDataLink>{link}</PointDataLink>{valid}</DataLink>")
            },
            |list| format!("<DataList>{list}</DataList>"),
        );
        let (name, space) = root
            .split_once(':')
            .map_or((*root, "xmlns"), |_| (*root, "xmlns:p"));
        let head = format!(
            "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<{name} {space}=\"http://www.opengps.eu/2008/ISO5436_2\">\n\
             <Record1><Revision>{revision}</Revision><FeatureType>SUR</FeatureType><Axes>\
             <CX><AxisType>I</AxisType><DataType>L</DataType><Increment>{step_x}</Increment><Offset>0</Offset></CX>\
             <CY><AxisType>I</AxisType><DataType>L</DataType><Increment> {step_y} </Increment><Offset>0</Offset></CY>\
             <CZ><AxisType>A</AxisType><DataType>{z}</DataType><Increment>{z_step}</Increment><Offset>{OFFSET_M:e}</Offset></CZ>\
             </Axes></Record1><Record2><Date>yesterday</Date><Comment>"
        );
        let tail = format!(
            "</Comment></Record2><Record3><MatrixDimension><SizeX>{COLUMNS}</SizeX><SizeY>{ROWS}</SizeY><SizeZ>1</SizeZ>\
             </MatrixDimension>{place}</Record3><Record4><ChecksumFile>md5checksum.hex</ChecksumFile></Record4></{name}>"
        );
        [head.as_bytes(), self.comment, tail.as_bytes()].concat()
    }

    fn bytes(&self) -> Vec<u8> {
        self.with(&self.xml())
    }

    /// With another main.xml.
    fn with(&self, xml: &[u8]) -> Vec<u8> {
        let mut zip = ZipWriter::new(Cursor::new(Vec::new()));
        let mut put = |name: &str, bytes: &[u8]| {
            zip.start_file(
                format!("{}{name}", self.folder),
                SimpleFileOptions::default(),
            )
            .unwrap();
            zip.write_all(bytes).unwrap();
        };
        put("__MACOSX/._main.xml", b"resource fork");
        put("__MACOSX/main.xml", b"not this one");
        put("main.xml", xml);
        if self.list.is_none() {
            put("bindata/data.bin", &self.data);
        }
        if let Some(valid) = self.valid.as_ref().filter(|valid| !valid.is_empty()) {
            put("bindata/valid.bin", valid);
        }
        if self.checksum {
            let sum = match self.sum {
                Some(sum) => sum.to_owned(),
                None => format!("{:x} *main.xml\n", md5::compute(self.xml())),
            };
            put("md5checksum.hex", sum.as_bytes());
        }
        zip.finish().unwrap().into_inner()
    }
}

/// Heights as text of a `DataList`.
fn as_list() -> X3p {
    let mut list = String::new();
    for z_m in heights_m() {
        writeln!(list, "<Datum>;;{:e}</Datum>", z_m - OFFSET_M).unwrap();
    }
    let mut file = X3p::new("D", Vec::new());
    file.list = Some(list);
    file
}

/// What a `.sur` holds, in nm and µm.
#[derive(Clone)]
struct Sur {
    kind: i16,
    bits: i16,
    units: [&'static [u8]; 3],
    steps: [f32; 2],
    points: Vec<i32>,
    special: bool,
    packed: bool,
    total: i32,
    flags: [i16; 2],
    tail: usize,
}

const SUR_MIN: i32 = -30000;

impl Sur {
    fn new(bits: i16, packed: bool) -> Self {
        Self {
            kind: 2,
            bits,
            units: [b"\xb5m", "µm".as_bytes(), b"nm"],
            steps: [20.0; 2],
            points: counts(),
            special: false,
            packed,
            total: (COLUMNS * ROWS) as i32,
            flags: [0; 2],
            tail: 0,
        }
    }

    fn bytes(&self) -> Vec<u8> {
        let mut head = vec![0_u8; 512];
        let mut put = |at: usize, bytes: &[u8]| head[at..at + bytes.len()].copy_from_slice(bytes);
        put(
            0,
            if self.packed {
                b"DSCOMPRESSED"
            } else {
                b"DIGITAL SURF"
            },
        );
        put(14, &1_i16.to_le_bytes());
        put(16, &1_i16.to_le_bytes());
        put(18, &self.kind.to_le_bytes());
        put(86, &i16::from(self.special).to_le_bytes());
        put(98, &self.bits.to_le_bytes());
        put(100, &SUR_MIN.to_le_bytes());
        put(104, &30000_i32.to_le_bytes());
        put(108, &(COLUMNS as i32).to_le_bytes());
        put(112, &(ROWS as i32).to_le_bytes());
        put(116, &self.total.to_le_bytes());
        put(120, &self.steps[0].to_le_bytes());
        put(124, &self.steps[1].to_le_bytes());
        put(128, &0.1_f32.to_le_bytes());
        for at in [132, 148, 164, 180, 196, 212, 228, 244, 260] {
            put(at, b"                ");
        }
        for (at, unit) in [180, 196, 212].into_iter().zip(self.units) {
            put(at, unit);
        }
        put(288, &self.flags[0].to_le_bytes());
        put(290, &self.flags[1].to_le_bytes());
        put(334, &7_i16.to_le_bytes());
        put(336, &3_i16.to_le_bytes());
        put(474, &300_f32.to_le_bytes());
        let points: Vec<u8> = match self.bits {
            16 => self
                .points
                .iter()
                .flat_map(|&z| (z as i16).to_le_bytes())
                .collect(),
            _ => self.points.iter().flat_map(|z| z.to_le_bytes()).collect(),
        };
        head.extend(b"comment");
        head.extend(b"own");
        if self.packed {
            // Two streams.
            let parts = points.split_at((points.len() / 3) & !3);
            let streams = [parts.0, parts.1].map(|part| {
                let mut stream = ZlibEncoder::new(Vec::new(), Compression::default());
                stream.write_all(part).unwrap();
                (part.len(), stream.finish().unwrap())
            });
            head.extend(2_u32.to_le_bytes());
            for (length, stream) in &streams {
                head.extend((*length as u32).to_le_bytes());
                head.extend((stream.len() as u32).to_le_bytes());
            }
            head.extend(streams.into_iter().flat_map(|(_, stream)| stream));
        } else {
            head.extend(points);
        }
        head.extend(vec![0; self.tail]);
        head
    }
}

fn load(folder: &Path, name: &str, bytes: &[u8], keys: &str) -> Result<Scene, String> {
    std::fs::write(folder.join(name), bytes).unwrap();
    let text = format!(
        "[contact]\nkind = \"point\"\nrx_m = 0.0125\nry_m = 0.0125\n\n[body_2.surface]\nkind = \"height_map\"\n\
         file = \"{name}\"\nlevel = \"none\"\n{keys}\n[motion]\nentrainment_m_s = 1.0\n\n[load]\nforce_n = 50.0\n\n\
         [lubricant]\nviscosity_pa_s = 0.1\npressure_viscosity_per_pa = 2e-8\n\n[grid]\nnodes = 129\n"
    );
    let path = folder.join("scene.toml");
    std::fs::write(&path, text).unwrap();
    Scene::load(path.to_str().unwrap()).map_err(|error| error.to_string())
}

/// What is read of such a file: report, pixel, heights.
fn read(name: &str, bytes: &[u8], keys: &str) -> Result<(MapReport, f64, Vec<f64>), String> {
    let folder = tempfile::tempdir().unwrap();
    let scene = load(folder.path(), name, bytes, keys)?;
    let [None, Some(report)] = scene.map_reports() else {
        panic!("one map");
    };
    let Surface::HeightMap {
        pixel_m: Some(pixel_m),
        map: Some(map),
        ..
    } = &scene.body_2.surface
    else {
        panic!("a map");
    };
    // At the pixels interpolation is the identity.
    let at = |n: usize| {
        let place = |k: usize, all: usize| k as f64 - 0.5 * (all - 1) as f64;
        let (i, j) = (place(n % COLUMNS, COLUMNS), place(n / COLUMNS, ROWS));
        map.sample(i, j) * map.peak_m
    };
    Ok((report, *pixel_m, (0..COLUMNS * ROWS).map(at).collect()))
}

fn refused(name: &str, bytes: &[u8]) -> String {
    read(name, bytes, "").map_or_else(|error| error, |_| "accepted".to_owned())
}

fn agree(name: &str, found: &[f64], rounding_m: f64) {
    for (n, (one, two)) in found.iter().zip(heights_m()).enumerate() {
        assert!(
            (one - two).abs() < rounding_m,
            "{name}: {n}: {one:e} {two:e}"
        );
    }
}

#[test]
fn every_format_gives_the_same_heights() {
    let shape = crate::common::maps::Shape::new(COLUMNS, ROWS, |i, j| heights_m()[j * COLUMNS + i]);
    let folder = tempfile::tempdir().unwrap();
    crate::common::maps::npy_f8(&folder.path().join("map.npy"), &shape);
    crate::common::maps::csv(&folder.path().join("map.csv"), &shape, 1e6);
    let file = |name: &str| std::fs::read(folder.path().join(name)).unwrap();
    let mut spaceless = X3p::of("D");
    (spaceless.root, spaceless.revision) = ("ISO25178_72", "ISO25178-72:2017/DAM1");
    let mut gwyddion = Sur::new(32, false);
    gwyddion.kind = 1;
    for (name, bytes, keys) in [
        ("map.npy", file("map.npy"), "pixel_m = 2e-5"),
        ("map.csv", file("map.csv"), "pixel_m = 2e-5\nunit_m = 1e-6"),
        ("int16.x3p", X3p::of("I").bytes(), ""),
        ("int32.x3p", X3p::of("L").bytes(), ""),
        ("float32.x3p", X3p::of("F").bytes(), ""),
        (
            "float64.x3p",
            X3p::of("D").bytes(),
            "pixel_m = 2e-5\nunit_m = 1.0",
        ),
        ("spaceless.X3P", spaceless.bytes(), ""),
        ("text.x3p", as_list().bytes(), ""),
        ("int16.sur", Sur::new(16, false).bytes(), ""),
        ("int32.sur", Sur::new(32, false).bytes(), "unit_m = 1e-9"),
        ("packed16.sur", Sur::new(16, true).bytes(), ""),
        ("packed32.sur", Sur::new(32, true).bytes(), ""),
        ("gwyddion.sur", gwyddion.bytes(), ""),
    ] {
        let (report, pixel_m, found) = read(name, &bytes, keys).unwrap();
        assert!(
            (pixel_m / PIXEL_M - 1.0).abs() < 1e-12,
            "{name}: {pixel_m:e}"
        );
        assert_eq!((report.columns, report.rows), (COLUMNS, ROWS), "{name}");
        assert_eq!(
            (report.missing, &report.defects[..]),
            (0, &[][..]),
            "{name}"
        );
        // A map is held in 32 bits: 2^-24 of its 0.6 µm.
        agree(name, &found, 1e-13);
    }
}

/// Points that are taken out: inside, at an edge, in a corner.
const TORN: [usize; 4] = [0, 5 * COLUMNS + 9, 5 * COLUMNS + 10, 12 * COLUMNS - 1];

#[test]
fn missing_points_are_filled_and_counted() {
    let mut valid = vec![0xff_u8; (COLUMNS * ROWS).div_ceil(8)];
    for n in TORN {
        valid[n / 8] &= !(1 << (n % 8));
    }
    let mut files = Vec::new();
    for z in ["I", "L", "F", "D"] {
        let mut file = X3p::of(z);
        file.valid = Some(valid.clone());
        files.push((format!("{z}.x3p"), file.bytes()));
    }
    let mut nan = X3p::of("D");
    for n in TORN {
        nan.data[8 * n..8 * n + 8].copy_from_slice(&f64::NAN.to_le_bytes());
    }
    files.push(("nan.x3p".to_owned(), nan.bytes()));
    let mut text = as_list();
    let mut rows: Vec<String> = text.list.unwrap().lines().map(str::to_owned).collect();
    for n in TORN {
        rows[n] = "<Datum/>".to_owned();
    }
    text.list = Some(rows.join("\n"));
    files.push(("text.x3p".to_owned(), text.bytes()));
    for (bits, packed) in [(16, false), (32, false), (32, true)] {
        let mut file = Sur::new(bits, packed);
        file.special = true;
        for n in TORN {
            file.points[n] = SUR_MIN - 2;
        }
        files.push((format!("{bits}{packed}.sur"), file.bytes()));
    }
    // By hand of the corner: the mean of the two beside it.
    let mut filled = heights_m();
    let z = heights_m();
    filled[0] = 0.5 * (z[1] + z[COLUMNS]);
    for (name, bytes) in &files {
        let (report, _, found) = read(name, bytes, "").unwrap();
        assert_eq!(report.missing, 4, "{name}");
        let lines = report.lines().join("\n");
        assert!(
            lines.contains("4 missing points filled from their neighbours"),
            "{lines}"
        );
        assert!((found[0] - filled[0]).abs() < 1e-13, "{name}");
        for (n, (one, two)) in found.iter().zip(&z).enumerate() {
            assert!(
                TORN.contains(&n) || (one - two).abs() < 1e-13,
                "{name}: {n}"
            );
        }
    }
    let mut file = Sur::new(16, false);
    file.special = true;
    file.points[..49].fill(SUR_MIN - 2);
    let text = refused("torn.sur", &file.bytes());
    assert!(
        text.contains("49 of 480 points are missing") && text.contains("at most 10 %"),
        "{text}"
    );
}

/// The sum of a file that was written elsewhere, by `md5sum`: upper case counts as lower.
#[test]
fn the_sum_is_that_of_md5sum() {
    assert_eq!(
        format!("{:x}", md5::compute(b"asperity\n")),
        "6c86112f4557936c37469ba5a439d633"
    );
    let mut file = X3p::of("D");
    let sum = format!("{:X}  main.xml", md5::compute(file.xml()));
    file.sum = Some(Box::leak(sum.into_boxed_str()));
    let (report, ..) = read("a.x3p", &file.bytes(), "").unwrap();
    assert_eq!(report.defects, []);
}

#[test]
fn defects_are_read_and_named() {
    let x3p = |change: &dyn Fn(&mut X3p)| {
        let mut file = X3p::of("D");
        change(&mut file);
        file.bytes()
    };
    let sur = |change: &dyn Fn(&mut Sur)| {
        let mut file = Sur::new(16, false);
        change(&mut file);
        file.bytes()
    };
    for (name, bytes, defects) in [
        (
            "a.x3p",
            x3p(&|f| f.folder = "scan 1/"),
            &[FileDefect::Folder][..],
        ),
        (
            "a.x3p",
            x3p(&|f| f.checksum = false),
            &[FileDefect::NoChecksum],
        ),
        (
            "a.x3p",
            x3p(&|f| f.sum = Some("00000000000000000000000000000000 *main.xml\n")),
            &[FileDefect::WrongChecksum],
        ),
        (
            "a.x3p",
            x3p(&|f| f.sum = Some("")),
            &[FileDefect::WrongChecksum],
        ),
        (
            "a.x3p",
            x3p(&|f| f.revision = "2.0 beta"),
            &[FileDefect::Revision],
        ),
        ("a.x3p", x3p(&|f| f.link = "\\bindata\\DATA.bin"), &[]),
        ("a.x3p", x3p(&|f| f.link = "data.bin"), &[FileDefect::Link]),
        (
            "a.x3p",
            x3p(&|f| f.valid = Some(vec![])),
            &[FileDefect::NoValidity],
        ),
        (
            "a.x3p",
            x3p(&|f| f.step_x = "2,0E-5".to_owned()),
            &[FileDefect::DecimalComma],
        ),
        ("a.x3p", x3p(&|f| f.data.push(0)), &[FileDefect::LongData]),
        ("a.x3p", x3p(&|f| f.comment = b"5 \xb5m"), &[]),
        ("a.x3p", x3p(&|f| f.step_y = "2.0018e-5".to_owned()), &[]),
        ("a.sur", sur(&|f| f.total = 0), &[FileDefect::PointCount]),
        (
            "a.sur",
            sur(&|f| f.flags = [1, 1]),
            &[FileDefect::Inverted, FileDefect::Replica],
        ),
        ("a.sur", sur(&|f| f.tail = 9), &[FileDefect::LongData]),
    ] {
        let (report, _, found) = read(name, &bytes, "").unwrap();
        assert_eq!(report.defects, defects, "{name}");
        agree(name, &found, 1e-13);
        let lines = report.lines().join("\n");
        for defect in defects {
            assert!(lines.contains(defect.name()), "{lines}");
        }
    }
}

#[test]
fn what_cannot_be_read_is_refused_with_words() {
    let x3p = |z: &'static str, change: &dyn Fn(&mut X3p)| {
        let mut file = X3p::of(z);
        change(&mut file);
        refused("a.x3p", &file.bytes())
    };
    let sur = |change: &dyn Fn(&mut Sur)| {
        let mut file = Sur::new(16, false);
        change(&mut file);
        refused("a.sur", &file.bytes())
    };
    for (text, parts) in [
        (
            x3p("D", &|f| f.step_y = "3e-5".to_owned()),
            &["as wide as high", "2e-5 m by 3e-5 m"][..],
        ),
        (
            x3p("D", &|f| f.step_x = "-2e-5".to_owned()),
            &["as wide as high"],
        ),
        (
            x3p("D", &|f| f.step_x = "nan".to_owned()),
            &["CX/Increment is NaN"],
        ),
        (
            x3p("D", &|f| f.z_step = "1e-6".to_owned()),
            &["increment of z of 0.000001", "two readings"],
        ),
        (
            x3p("D", &|f| f.z = "Q"),
            &["heights of type \"Q\"", "I, L, F or D"],
        ),
        (x3p("D", &|f| f.link = "else.bin"), &["no \"else.bin\""]),
        (
            x3p("D", &|f| f.data.truncate(99)),
            &["99 bytes of points", "3840"],
        ),
        (
            x3p("I", &|f| f.valid = Some(vec![])),
            &["no \"bindata/valid.bin\""],
        ),
        (
            x3p("I", &|f| f.valid = Some(vec![1])),
            &["1 bytes of valid points", "60"],
        ),
        (
            sur(&|f| f.units[2] = b"V"),
            &["the unit of dz is \"V\"", "a unit of length"],
        ),
        (sur(&|f| f.units[0] = b""), &["the unit of dx is \"\""]),
        (sur(&|f| f.steps[1] = 30.0), &["as wide as high"]),
        (sur(&|f| f.bits = 8), &["points of 8 bits"]),
        (sur(&|f| f.kind = 5), &["an object of kind 5"]),
        (
            sur(&|f| f.points.truncate(9)),
            &["18 bytes of points", "960"],
        ),
        (refused("a.sur", b"DIGITAL SURF"), &["cut short"]),
        (refused("a.x3p", b"PK\x03\x04"), &["not a .x3p"]),
    ] {
        for part in parts {
            assert!(text.contains(part), "{part}: {text}");
        }
        assert!(text.contains("body_2.surface.file"), "{text}");
    }
}

#[test]
fn bombs_are_not_unpacked() {
    // 256 MiB of zeros in 256 KiB, where 3840 bytes are enough.
    let mut file = X3p::of("D");
    file.data.resize(256 << 20, 0);
    let bytes = file.bytes();
    assert!(bytes.len() < 1 << 20);
    let start = Instant::now();
    let (report, _, found) = read("a.x3p", &bytes, "").unwrap();
    assert_eq!(report.defects, [FileDefect::LongData]);
    agree("a.x3p", &found, 1e-13);
    let mut sur = Sur::new(32, true);
    sur.points = vec![0; 1 << 20];
    assert!(refused("a.sur", &sur.bytes()).contains("bytes of points"));
    assert!(start.elapsed() < Duration::from_secs(5));
}

/// Two thousand damaged files of all kinds: whole archives, what is packed in them, and `.sur`. Each is read or refused, by its key,
/// in words that a terminal can show, and at once.
#[test]
fn damaged_files_are_refused_in_words() {
    const FILES: u64 = 2000;
    let archives: Vec<X3p> = (["I", "L", "F", "D"].into_iter().map(X3p::of))
        .chain([as_list()])
        .collect();
    let surfs = [(16, false), (32, false), (16, true), (32, true)];
    let surfs = surfs.map(|(bits, packed)| Sur::new(bits, packed).bytes());
    let folder = tempfile::tempdir().unwrap();
    let (mut accepted, mut refused) = (0, 0);
    for n in 0..FILES {
        let mut random = Random::new("surfaces", n);
        let (archive, other) = (
            &archives[random.below(archives.len())],
            &archives[random.below(archives.len())],
        );
        let (name, bytes) = match n % 4 {
            0 => (
                "a.x3p",
                mutate::bytes(&mut random, &archive.bytes(), &other.bytes()),
            ),
            1 => {
                let xml = mutate::bytes(&mut random, &archive.xml(), &other.xml());
                ("a.x3p", archive.with(&xml))
            }
            2 => {
                let mut file = archive.clone();
                file.data = mutate::bytes(&mut random, &archive.data, &other.data);
                file.valid = Some(mutate::bytes(&mut random, &[255; 60], &[0; 9]));
                ("a.x3p", file.bytes())
            }
            _ => {
                let two = [(); 2].map(|()| &surfs[random.below(surfs.len())]);
                ("a.sur", mutate::bytes(&mut random, two[0], two[1]))
            }
        };
        let began = Instant::now();
        match load(folder.path(), name, &bytes, "") {
            Ok(_) => accepted += 1,
            Err(words) => {
                refused += 1;
                assert!(words.contains("body_2.surface"), "{n}: {words}");
                assert!(
                    !words.chars().any(|c| c.is_control() && c != '\n'),
                    "{n}: {words:?}"
                );
                assert!(words.len() < 1000, "{n}: {words}");
            }
        }
        assert!(
            began.elapsed() < Duration::from_secs(5),
            "{n}: {:?}",
            began.elapsed()
        );
    }
    println!("{accepted} read, {refused} refused");
    assert!(accepted > 100 && refused > 500, "{accepted} {refused}");
}
