//! Made surfaces against the formulas of random surfaces, which know nothing of how they are made.

use std::f64::consts::TAU;

use asperity_engine::physics::height_map::HeightMap;
use asperity_engine::physics::random_surface::{Autocorrelation, RandomSpectrum};
use asperity_engine::scene::{Override, Scene, Surface};

const SEEDS: u64 = 50;
const L: f64 = 40e-6;

fn spectrum(autocorrelation: Autocorrelation, correlation_m: [f64; 2]) -> RandomSpectrum {
    RandomSpectrum {
        seed: 1,
        autocorrelation,
        correlation_m,
        hurst: 0.8,
        cutoff_short_m: 0.5 * L,
        cutoff_long_m: f64::INFINITY,
        period_m: correlation_m.map(|l| 32.0 * l),
        skewness: 0.0,
        kurtosis: 3.0,
    }
}

fn made(spectrum: RandomSpectrum, seed: u64) -> HeightMap {
    RandomSpectrum { seed, ..spectrum }
        .make()
        .expect("it has waves")
}

/// Heights on the pixels over Sq, row after row.
struct Heights {
    nx: usize,
    z: Vec<f64>,
}

impl Heights {
    fn of(map: &HeightMap) -> Self {
        let (nx, ny) = (map.nx(), map.ny());
        let mut row = vec![0.0_f32; nx];
        let mut z = Vec::new();
        for j in 0..ny {
            map.row_into(j as f64 - 0.5 * (ny - 1) as f64, &mut row);
            z.extend(row.iter().map(|&z| f64::from(z) / map.rms));
        }
        Self { nx, z }
    }

    fn at(&self, i: usize, j: usize) -> f64 {
        let ny = self.z.len() / self.nx;
        self.z[(j % ny) * self.nx + i % self.nx]
    }

    fn autocorrelation(&self, [di, dj]: [usize; 2]) -> f64 {
        let pairs = (0..self.z.len()).map(|n| {
            let (i, j) = (n % self.nx, n / self.nx);
            self.z[n] * self.at(i + di, j + dj)
        });
        pairs.sum::<f64>() / self.z.len() as f64
    }

    /// Maxima along x of the first row.
    fn maxima(&self) -> f64 {
        let is_maximum = |&i: &usize| {
            let [before, here, after] = [i + self.nx - 1, i, i + 1].map(|i| self.at(i, 0));
            before < here && here >= after
        };
        (0..self.nx).filter(is_maximum).count() as f64
    }
}

/// Means over the seeds and their standard errors.
fn over_seeds<const N: usize>(of: impl Fn(u64) -> [f64; N]) -> [(f64, f64); N] {
    let all: Vec<[f64; N]> = (0..SEEDS).map(of).collect();
    let n = all.len() as f64;
    std::array::from_fn(|k| {
        let mean = all.iter().map(|values| values[k]).sum::<f64>() / n;
        let squares = all.iter().map(|values| (values[k] - mean).powi(2));
        (mean, (squares.sum::<f64>() / (n - 1.0) / n).sqrt())
    })
}

/// Of white normal numbers Sq is as asked, Ssk 0 and Sku 3, and heights a correlation length apart correlate by 1/e, along and
/// across, of every law and lay.
#[test]
fn moments_and_correlation_are_those_asked_for() {
    let e = (-1.0_f64).exp();
    for (law, lengths, cut) in [
        (Autocorrelation::Gaussian, [L, L], 0.5),
        (Autocorrelation::Gaussian, [L, 4.0 * L], 0.5),
        (Autocorrelation::Gaussian, [L, f64::INFINITY], 0.5),
        (Autocorrelation::Gaussian, [f64::INFINITY, L], 0.5),
        (Autocorrelation::Exponential, [L, L], 0.25),
        (Autocorrelation::Exponential, [L, f64::INFINITY], 0.03),
    ] {
        let mut spectrum = spectrum(law, lengths);
        spectrum.cutoff_short_m = cut * L;
        let [nx, ny] = spectrum.pixels();
        let found = over_seeds(|seed| {
            let map = made(spectrum, seed);
            let heights = Heights::of(&map);
            let [skewness, kurtosis] = map.moments();
            let along = heights.autocorrelation([nx / 32, 0]);
            [
                skewness,
                kurtosis,
                along,
                heights.autocorrelation([0, ny / 32]),
            ]
        });
        println!("{} {lengths:?}: {found:.4?}", law.key());
        let [(skewness, its), (kurtosis, of_kurtosis), ..] = found;
        assert!(skewness.abs() < 4.0 * its, "Ssk");
        // Finite maps of few correlation lengths have a kurtosis a little below 3.
        assert!((kurtosis - 3.0).abs() < 4.0 * of_kurtosis + 0.05, "Sku");
        for (n, (found, its)) in [nx, ny].into_iter().zip([found[2], found[3]]) {
            // The mean taken off makes a map of 32 lengths correlate a little less; what the cut-off takes, a little more.
            let expected = if n == 1 { 1.0 } else { e };
            assert!(
                (found - expected).abs() < 4.0 * its + 0.03,
                "{found} ± {its}"
            );
        }
    }
}

/// √(m₄/m₂)/2π maxima a length of a normal profile (Longuet-Higgins 1957, Nayak 1971): .39/L of a Gaussian correlation; by
/// a power law with H = .8, cut-offs 16, 64 and 256 apart, 8, 29 and 111 in each longest wave.
#[test]
fn maxima_are_as_many_as_the_spectrum_says() {
    let ridges = spectrum(Autocorrelation::Gaussian, [L, f64::INFINITY]);
    let maxima = |seed, spectrum| Heights::of(&made(spectrum, seed)).maxima();
    let [(density, its)] = over_seeds(|seed| [maxima(seed, ridges) / ridges.period_m[0]]);
    println!("gaussian: {:.4} ± {:.4} / L (0.3898)", density * L, its * L);
    assert!((density * L - 0.3898).abs() < 3.0 * its * L + 0.004);
    for (apart, expected) in [(16.0, 8.0), (64.0, 29.0), (256.0, 111.0)] {
        let mut rough = spectrum(Autocorrelation::SelfAffine, [1.0, f64::INFINITY]);
        rough.cutoff_long_m = apart * L;
        rough.cutoff_short_m = L;
        rough.period_m = [32.0 * apart * L, f64::INFINITY];
        let [(found, its)] = over_seeds(|seed| [maxima(seed, rough) / 32.0]);
        println!("power law, {apart}: {found:.2} ± {its:.2} in a longest wave ({expected})");
        assert!(
            (found / expected - 1.0).abs() < 0.03,
            "{found} ± {its}, not {expected}"
        );
    }
}

/// A shorter cut-off adds waves to the surface and leaves those that it had.
#[test]
fn a_shorter_cut_off_adds_to_the_same_surface() {
    let mut spectrum = spectrum(Autocorrelation::Exponential, [L, f64::INFINITY]);
    let of = |spectrum: &RandomSpectrum| {
        let heights = Heights::of(&made(*spectrum, 7));
        let n = heights.nx;
        // Complex amplitude of the first modes over that of mode 1.
        let mode = |k: usize| {
            let (mut re, mut im) = (0.0, 0.0);
            for i in 0..n {
                let angle = TAU * (k * i) as f64 / n as f64;
                re += heights.at(i, 0) * angle.cos() / n as f64;
                im -= heights.at(i, 0) * angle.sin() / n as f64;
            }
            re.hypot(im)
        };
        (2..20).map(|k| mode(k) / mode(1)).collect::<Vec<f64>>()
    };
    let long = of(&spectrum);
    spectrum.cutoff_short_m *= 0.125;
    for (one, other) in long.iter().zip(of(&spectrum)) {
        assert!((one / other - 1.0).abs() < 1e-6, "{one} {other}");
    }
    let [one, another] = [7, 8].map(|seed| Heights::of(&made(spectrum, seed)).at(3, 0));
    assert!((one - another).abs() > 1e-3);
}

fn setting(text: &str) -> Override {
    text.parse().expect("a setting")
}

fn scene(settings: &[&str]) -> Result<Scene, String> {
    let common = [
        "body_1.surface.kind=random",
        "body_1.surface.rq_m=1e-7",
        "body_1.surface.correlation_x_m=4e-5",
    ];
    let all: Vec<Override> = common
        .iter()
        .chain(settings)
        .map(|text| setting(text))
        .collect();
    Scene::load_with("demonstration", &all).map_err(|error| error.to_string())
}

#[test]
fn a_scene_keeps_its_surface() {
    let made = scene(&[]).expect("defaults do");
    let Surface::Random(random) = &made.body_1.surface else {
        panic!("it is random");
    };
    assert_eq!((random.seed, random.cutoff_short_m()), (Some(1), 4e-5));
    assert!((made.body_1.surface.rq_m() - 1e-7).abs() < 1e-20);
    let again = Scene::from_toml(&made.to_toml()).expect("it reads its own");
    assert_eq!(made, again);
    assert_ne!(scene(&["body_1.surface.seed=2"]).expect("another"), made);
    // One key draws another pair.
    let both = ["kind=random", "rq_m=1e-7", "correlation_x_m=4e-5"]
        .map(|key| format!("body_2.surface.{key}"));
    let of = |seed: &str| {
        let settings = [&both[0], &both[1], &both[2], seed];
        scene(&settings)
            .expect("it fits")
            .surfaces()
            .map(|surface| match surface {
                Surface::Random(random) => random.seed,
                _ => None,
            })
    };
    assert_eq!(of("body_1.surface.seed=7"), [Some(7), Some(1_000_007)]);
    let mut turned = made.clone();
    turned.body_1.surface.set_amplitude_m(5e-7);
    assert!((turned.body_1.surface.amplitude_m() / 5e-7 - 1.0).abs() < 1e-12);
}

#[test]
fn what_does_not_fit_is_refused_by_name() {
    for (settings, words) in [
        (
            &["body_1.surface.correlation_x_m=none"][..],
            "body_1.surface.correlation_x_m",
        ),
        (
            &["body_1.surface.autocorrelation=self_affine"],
            "body_1.surface.cutoff_short_m",
        ),
        (
            &[
                "body_1.surface.autocorrelation=self_affine",
                "body_1.surface.cutoff_short_m=1e-5",
            ],
            "body_1.surface.cutoff_long_m",
        ),
        (&["body_1.surface.hurst=0.8"], "self_affine"),
        (
            &["body_1.surface.cutoff_long_m=3e-5"],
            "more than cutoff_short_m, 4e-5 m",
        ),
        (&["body_1.surface.cutoff_short_m=2e-7"], "pixels"),
        (
            &[
                "body_1.surface.period_x_m=3e-5",
                "body_1.surface.period_y_m=3e-5",
            ],
            "leaves no wave",
        ),
        (&["body_1.surface.rq_m=2e-5"], "body_1.surface.rq_m"),
        (
            &["body_1.surface.amplitude_m=2e-7"],
            "\"sinusoid\" or \"height_map\"",
        ),
        (
            &["body_2.surface.kind=smooth", "body_2.surface.rq_m=2e-7"],
            "body_2.surface.rq_m",
        ),
        (
            &["body_1.surface.correlation_x_m=inf"],
            "when correlation_y_m is inf too",
        ),
        (
            &["contact.kind=line", "body_2.surface.kind=smooth"],
            "body_1.surface.correlation_y_m = 4e-5 m",
        ),
    ] {
        let error = scene(settings).expect_err("it does not fit");
        assert!(error.contains(words), "{settings:?}: {error}");
    }
}

/// Skewed and peaked heights, with the spectrum of the normal ones: found moments over ten seeds, and the correlation as before.
#[test]
fn heights_may_be_skewed_and_peaked() {
    for (skewness, kurtosis) in [(-1.0, 4.5), (0.8, 4.0), (0.0, 5.0), (0.0, 2.2)] {
        let mut shaped = spectrum(Autocorrelation::Exponential, [L, L]);
        (shaped.skewness, shaped.kurtosis) = (skewness, kurtosis);
        let normal = spectrum(Autocorrelation::Exponential, [L, L]);
        for seed in 1..4 {
            let map = made(shaped, seed);
            let [found_skewness, found_kurtosis] = map.moments();
            println!(
                "Ssk {found_skewness:.3} for {skewness}, Sku {found_kurtosis:.3} for {kurtosis}"
            );
            assert!((found_skewness - skewness).abs() < 0.1);
            assert!((found_kurtosis - kurtosis).abs() < 0.3);
            let [own, other] = [shaped, normal]
                .map(|spectrum| Heights::of(&made(spectrum, seed)).autocorrelation([8, 0]));
            assert!((own - other).abs() < 1e-5, "{own} {other}");
        }
    }
}
