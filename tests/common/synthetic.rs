//! Frames that look like a rough passage without a solver: Hertz's pressure with moving ripples, a
//! film in the shape of Hertz's gap, McEwen's stresses below a line contact. Nothing of it is
//! physics; it has the shapes, sizes and ranges of a passage.

use std::sync::Arc;

use asperity_engine::observe::{Began, RunContext};
use asperity_engine::scene::{
    Body, Contact, ContactKind, Event, Friction, GridAsked, Load, Motion, Numerics, Record, Scene,
    Surface, Time,
};
use asperity_engine::sim::{
    Frame, LifeEstimate, LubricationRegime, MaterialPoint, Metrics, PassedPeak, Stage, StressSlice,
};

/// Half-width, m.
pub(crate) const A: f64 = 0.47e-3;
const P_HERTZ: f64 = 1.73e9;
const RADIUS: f64 = 0.01905;
const AMPLITUDE: f64 = 2.0e-7;
const WAVELENGTH: f64 = 1.0e-4;
const ENTRAINMENT: f64 = 1.0;
const SLIDE_ROLL: f64 = 0.5;
const H_CENTRAL: f64 = 3.2e-7;

/// A scene of `nodes` per side and so many passages.
pub(crate) fn scene(nodes: usize, passages: f64) -> Scene {
    let surface = |wavelength_y_m| Surface::Sinusoid {
        amplitude_m: AMPLITUDE,
        wavelength_x_m: WAVELENGTH,
        wavelength_y_m,
        angle_deg: 0.0,
        phase_deg: 0.0,
    };
    let body = |surface| Body {
        surface,
        ..Body::default()
    };
    Scene {
        title: "Synthetic passage".into(),
        about: "Made-up fields for looking at recordings.".into(),
        contact: Contact {
            kind: ContactKind::Point,
            rx_m: RADIUS,
            ry_m: Some(RADIUS),
        },
        body_1: body(surface(f64::INFINITY)),
        body_2: body(surface(WAVELENGTH)),
        lubricant: None,
        friction: Friction::default(),
        motion: Motion {
            entrainment_m_s: ENTRAINMENT,
            slide_roll: SLIDE_ROLL,
        },
        load: Load {
            force_n: Some(800.0),
            force_n_per_m: None,
            hertz_pressure_pa: None,
        },
        grid: GridAsked {
            nodes,
            ..GridAsked::default()
        },
        time: Time {
            step_nodes: 1.0,
            passages: Some(passages),
            tolerance: None,
        },
        numerics: Numerics::default(),
        stress: None,
        life: None,
        heat: None,
        wear: None,
        age: None,
        tooth: None,
        record: Some(Record::default()),
        events: Vec::<Event>::new(),
    }
}

/// What an observer is told before the first frame.
pub(crate) fn context(scene: Scene) -> RunContext {
    RunContext {
        scene_toml: "title = \"Synthetic passage\"\n[motion]\nslide_roll = 0.5\n".into(),
        plan_text: "film: synthetic\nstress: synthetic\n".into(),
        program: format!("asperity {}", env!("CARGO_PKG_VERSION")),
        scene: Arc::new(scene),
        began: Began::FromScene,
    }
}

/// Depths that grow geometrically, as a solver's.
fn depths(n: usize) -> Arc<[f64]> {
    (0..n)
        .map(|k| 3.0 * A * (f64::from(k as u32) / (n - 1) as f64).powf(1.8))
        .collect()
}

fn roughness(body: u8, x: f64, y: f64, t: f64) -> f64 {
    let k = std::f64::consts::TAU / WAVELENGTH;
    if body == 1 {
        AMPLITUDE * (k * (x - ENTRAINMENT * (1.0 - 0.5 * SLIDE_ROLL) * t)).cos()
    } else {
        let wave = (k * (x - ENTRAINMENT * (1.0 + 0.5 * SLIDE_ROLL) * t)).cos();
        AMPLITUDE * wave * (k * y).cos()
    }
}

/// Frame number `step` of a passage on `n` by `n` nodes.
pub(crate) fn frame(n: usize, step: u64) -> Arc<Frame> {
    let dx = 4.0 * A / (n - 1) as f64;
    let t = step as f64 * dx / ENTRAINMENT;
    let (x_min, y_min) = (-2.5 * A, -2.0 * A);
    let at = |k: usize| (x_min + dx * (k % n) as f64, y_min + dx * (k / n) as f64);
    let field = |value: &dyn Fn(f64, f64) -> f64| -> Vec<f32> {
        (0..n * n)
            .map(&at)
            .map(|(x, y)| value(x, y) as f32)
            .collect()
    };
    let gap = |x: f64, y: f64| {
        let s = (x * x + y * y).sqrt() / A;
        let rise = if s > 1.0 {
            A * A / (std::f64::consts::PI * RADIUS)
                * ((s * s - 1.0).sqrt() + (s * s - 2.0) * (1.0 / s).acos())
        } else {
            0.0
        };
        let shoe =
            1.0 - 0.5 * (-((s - 0.93) / 0.08).powi(2)).exp() * f64::from(u8::from(x > -0.3 * A));
        let rough = roughness(1, x, y, t) + roughness(2, x, y, t);
        (H_CENTRAL * shoe + rise - 0.62 * rough).max(4.0e-9)
    };
    let pressure = |x: f64, y: f64| {
        let inside = 1.0 - (x * x + y * y) / (A * A);
        let rough = (roughness(1, x, y, t) + roughness(2, x, y, t)) / AMPLITUDE;
        P_HERTZ * inside.max(0.0).sqrt() * (1.0 + 0.22 * rough * inside.max(0.0).sqrt())
    };
    let film_m = field(&gap);
    let pressure_pa = field(&pressure);
    let contact = film_m.iter().map(|&h| u8::from(h <= 5.0e-9)).collect();
    let traction_pa = pressure_pa.iter().map(|p| 0.05 * p).collect();
    let p_max = pressure_pa.iter().fold(0.0_f32, |top, &p| top.max(p));
    let (slice, peak) = slice(n, dx, x_min, t);
    Arc::new(Frame {
        step,
        time_s: t,
        stage: Stage::Passage,
        kind: ContactKind::Point,
        passages: t * ENTRAINMENT / (4.0 * A),
        nx: n,
        ny: n,
        x_min_m: x_min,
        dx_m: dx,
        y_min_m: y_min,
        dy_m: dx,
        a_m: A,
        b_m: A,
        p_hertz_pa: P_HERTZ,
        roughness_1_m: field(&|x, y| roughness(1, x, y, t)),
        roughness_2_m: field(&|x, y| roughness(2, x, y, t)),
        pressure_pa,
        film_m,
        traction_pa,
        contact,
        slice: Some(slice),
        material_point: Some(point(t, &pressure)),
        metrics: metrics(step, t, f64::from(p_max), peak),
        ..Frame::default()
    })
}

fn point(t: f64, pressure: &dyn Fn(f64, f64) -> f64) -> MaterialPoint {
    let speed = ENTRAINMENT * (1.0 - 0.5 * SLIDE_ROLL);
    let x_m = (speed * t + 2.2 * A).rem_euclid(3.4 * A) - 2.2 * A;
    let pressure_pa = pressure(x_m, 0.0);
    let passed = ((x_m / A + 1.0).clamp(0.0, 2.0) * 2.2).floor();
    MaterialPoint {
        body: 1,
        x_m,
        depth_m: 0.3 * A,
        pressure_pa,
        effective_pa: 0.55 * pressure_pa,
        tau_xz_pa: 0.2 * pressure_pa * x_m / A,
        cycles_counted: passed,
        last_peak: (passed > 0.0).then(|| PassedPeak {
            x_m: (passed / 2.2 - 1.0) * A - 0.1 * A,
            pressure_pa,
        }),
        cycles_before: Some(4.0),
    }
}

/// McEwen's stresses of a line contact with a ripple near the surface, and their greatest value with
/// its depth and x.
fn slice(n: usize, dx: f64, x_min: f64, t: f64) -> (StressSlice, [f64; 3]) {
    let depths_m = depths(32);
    let (mut effective_pa, mut tau_xz_pa) = (Vec::new(), Vec::new());
    let mut peak = [0.0; 3];
    for &z in depths_m.iter() {
        for i in 0..n {
            let x = x_min + dx * i as f64;
            let base = A * A - x * x + z * z;
            let root = (base * base + 4.0 * x * x * z * z).sqrt();
            let m = (0.5 * (root + base)).max(0.0).sqrt();
            let s = (0.5 * (root - base)).max(0.0).sqrt();
            let d = (m * m + s * s).max(1e-18);
            let scale = P_HERTZ / A;
            let sx = -scale * (m * (1.0 + (z * z + s * s) / d) - 2.0 * z);
            let sz = -scale * m * (1.0 - (z * z + s * s) / d);
            let txz = -scale * s * (m * m - z * z) / d * x.signum();
            let sy = 0.3 * (sx + sz);
            let mises = (0.5 * ((sx - sy).powi(2) + (sy - sz).powi(2) + (sz - sx).powi(2))
                + 3.0 * txz * txz)
                .sqrt();
            let k = std::f64::consts::TAU / WAVELENGTH;
            let inside = (1.0 - (x / A).powi(2)).max(0.0).sqrt();
            let ripple = 0.5
                * P_HERTZ
                * inside
                * k
                * z
                * (-k * z).exp()
                * (1.0 + (k * (x - 1.1 * t * ENTRAINMENT)).cos());
            let value = mises + ripple;
            if value > peak[0] {
                peak = [value, z, x];
            }
            effective_pa.push(value as f32);
            tau_xz_pa.push(txz as f32);
        }
    }
    let slice = StressSlice {
        depths_m,
        effective_pa,
        tau_xz_pa,
    };
    (slice, peak)
}

fn metrics(step: u64, t: f64, p_max_pa: f64, [sigma, depth, x]: [f64; 3]) -> Metrics {
    let wobble = (t * ENTRAINMENT * std::f64::consts::TAU / WAVELENGTH).sin();
    let settling = 1.0 - (-(step as f64) / 40.0).exp();
    let cycle_factor = 0.26;
    let peak_factor = 0.2 + 0.6 * (1.0 - settling);
    let life_relative = cycle_factor * peak_factor * 0.9;
    Metrics {
        converged: true,
        residual: 4e-4 * (1.5 + wobble),
        newton_iterations: 3 + u32::from(wobble > 0.5),
        linear_iterations: 21,
        retries: 0,
        slide_roll: SLIDE_ROLL,
        slide_roll_target: SLIDE_ROLL,
        entrainment_m_s: ENTRAINMENT,
        load_n: 800.0,
        load_target_n: 800.0,
        amplitude_1_m: AMPLITUDE,
        amplitude_2_m: AMPLITUDE,
        p_max_pa,
        h_central_m: H_CENTRAL * (1.0 + 0.6 * wobble),
        h_min_m: 4.0e-9,
        h_mean_m: H_CENTRAL,
        lambda_ratio: Some(1.1),
        film_to_roughness: None,
        contact_ratio: 0.03 + 0.01 * wobble,
        contact_load_ratio: 0.05 + 0.012 * wobble,
        regime: LubricationRegime::Mixed,
        load_error: 3e-6 * (1.2 + wobble),
        film_error: 1e-3 * (1.3 + wobble),
        mass_error: 2e-5 * (1.3 + wobble),
        overlap_m: 0.0,
        asked: [1e-3, 1e-2],
        friction_coefficient: 0.052 + 0.002 * wobble,
        traction_max_pa: 4.7e7,
        sigma_eff_max_pa: Some(sigma),
        sigma_eff_max_depth_m: Some(depth),
        sigma_eff_max_x_m: Some(x),
        life: Some(LifeEstimate {
            i_ref: 1.0,
            i_mean: 3.0,
            phases: step as u32,
            cycle_factor,
            stress_factor: peak_factor * 0.9,
            peak_factor,
            traction_factor: 0.9,
            load_factor: 1.0,
            life_smooth: 1.0,
            life_relative,
            life_relative_low: life_relative * 0.8,
            life_relative_high: life_relative * 1.25,
            settled: step > 120,
            ..LifeEstimate::default()
        }),
        n_body_1: Some(4.2),
        n_body_2: Some(2.5),
        n_counted_body_1: (step > 60).then_some(4.0),
        n_counted_body_2: (step > 60).then_some(2.4),
        ..Metrics::default()
    }
}
