//! Synthetic frames that look like a run: a Hertz dome with ripples of both bodies that move at
//! their own speeds. Nothing here is physics; it is a picture to draw.

use std::f64::consts::TAU;
use std::sync::Arc;
use std::time::Duration;

use asperity_engine::plan::{LeftOut, Plan};
use asperity_engine::scene::{
    Body, Contact, ContactKind, CycleBasis, Life, Load, Motion, Record, Scene, Surface,
};
use asperity_engine::sim::{
    Frame, LifeDetail, LifeEstimate, LubricationRegime, MaterialPoint, Metrics, PassedPeak, Stage,
    StressSlice,
};
use asperity_explorer::tui::app::{App, Effect, ErrandKind};
use asperity_explorer::tui::event::{Pointer, PointerAct};
use asperity_explorer::tui::theme::{Capabilities, ColorDepth, Glyphs, Theme};
use asperity_explorer::tui::{RecorderActivity, RecorderState, RunStatus, Setup, view};
use asperity_session::run::{Command, Settled};
use asperity_session::sweep::{CaseStart, CurvePoint, Found};
use ratatui::Terminal;
use ratatui::backend::TestBackend;
use ratatui::buffer::Buffer;

/// Hertz half-width at 800 N, m.
pub(crate) const A_M: f64 = 2.2e-4;
/// Hertz pressure at 800 N, Pa.
pub(crate) const P_HERTZ_PA: f64 = 1.73e9;
const WAVE_M: f64 = 1.0e-4;
const NODES: usize = 65;

/// The knobs of a synthetic run.
#[derive(Debug, Clone, Copy)]
pub(crate) struct State {
    pub(crate) slide_roll: f64,
    pub(crate) slide_roll_target: f64,
    pub(crate) load_n: f64,
    pub(crate) load_target_n: f64,
    pub(crate) amplitude_1_m: f64,
    pub(crate) amplitude_2_m: f64,
    pub(crate) speed_m_s: f64,
    pub(crate) settled: bool,
    pub(crate) converged: bool,
}

impl Default for State {
    fn default() -> Self {
        Self {
            slide_roll: 0.5,
            slide_roll_target: 0.5,
            load_n: 800.0,
            load_target_n: 800.0,
            amplitude_1_m: 2.0e-7,
            amplitude_2_m: 2.0e-7,
            speed_m_s: 1.0,
            settled: true,
            converged: true,
        }
    }
}

pub(crate) fn scene() -> Scene {
    let wave = |wavelength_y_m| Body {
        surface: Surface::Sinusoid {
            amplitude_m: 2.0e-7,
            wavelength_x_m: WAVE_M,
            wavelength_y_m,
            angle_deg: 0.0,
            phase_deg: 0.0,
        },
        ..Body::default()
    };
    Scene {
        title: "Paper-like demonstration".into(),
        about: "Two crowned steel rollers, both rough.".into(),
        contact: Contact {
            kind: ContactKind::Point,
            rx_m: 0.01905,
            ry_m: Some(0.01905),
        },
        body_1: wave(f64::INFINITY),
        body_2: wave(WAVE_M),
        lubricant: None,
        friction: asperity_engine::scene::Friction::default(),
        motion: Motion {
            entrainment_m_s: 1.0,
            slide_roll: 0.5,
        },
        load: Load {
            force_n: Some(800.0),
            force_n_per_m: None,
            hertz_pressure_pa: None,
        },
        grid: asperity_engine::scene::GridAsked::default(),
        time: asperity_engine::scene::Time::default(),
        numerics: asperity_engine::scene::Numerics::default(),
        stress: Some(asperity_engine::scene::Stress::default()),
        // The paper's count: what follows from n can be worked out by hand.
        life: Some(Life {
            cycles: CycleBasis::Global,
            ..Life::default()
        }),
        heat: None,
        wear: None,
        age: None,
        tooth: None,
        record: Some(Record::default()),
        events: Vec::new(),
    }
}

pub(crate) fn theme(depth: ColorDepth, glyphs: Glyphs) -> Theme {
    Theme::new(Capabilities { depth, glyphs })
}

pub(crate) fn app(theme: Theme) -> App {
    let setup = Setup {
        scene: Arc::new(scene()),
        name: "demonstration".into(),
        load_n: 800.0,
        half_width_m: A_M,
        p_hertz_pa: P_HERTZ_PA,
        plan_text: "Plan for \"Paper-like demonstration\"\n  film       129 x 129, step 1 node\n  stress     y = 0 every step, volume 8 times a period\n  memory     84 MB".into(),
        left_out: vec![
            LeftOut {
                stage: "cavitation pools",
                why: "cavitation = \"reynolds\": the gap behind the contact counts as full".into(),
            },
            LeftOut {
                stage: "tangential displacement",
                why: "both bodies have the same elastic constants, so shear does not part them".into(),
            },
        ],
    };
    let errands = vec![ErrandKind::Record, ErrandKind::Save, ErrandKind::Rebuild];
    App::new(setup, errands, theme)
}

pub(crate) fn status(frames: u64) -> RunStatus {
    RunStatus {
        recorder: Some(RecorderState {
            output: "recordings/first.rrd".into(),
            activity: RecorderActivity::Recording,
            frames,
            skipped: 3,
            bytes: frames * 90_000,
        }),
        ..RunStatus::default()
    }
}

fn surface_1(state: &State, x: f64, travelled: f64) -> f64 {
    state.amplitude_1_m * (TAU * (x - (1.0 - 0.5 * state.slide_roll) * travelled) / WAVE_M).cos()
}

fn surface_2(state: &State, x: f64, y: f64, travelled: f64) -> f64 {
    let along = TAU * (x - (1.0 + 0.5 * state.slide_roll) * travelled) / WAVE_M;
    state.amplitude_2_m * along.cos() * (TAU * y / WAVE_M).cos()
}

fn pressure(state: &State, a: f64, p_h: f64, x: f64, y: f64, travelled: f64) -> f64 {
    let r2 = (x * x + y * y) / (a * a);
    let dome = (1.0 - r2).max(0.0).sqrt();
    let ripple = surface_1(state, x, travelled) + surface_2(state, x, y, travelled);
    (p_h * dome * (1.0 + 0.9e6 * ripple)).max(0.0)
}

/// A frame at a step; `dt` is one node at the entrainment speed.
pub(crate) fn frame(step: u64, state: &State) -> Frame {
    let size = (state.load_n / 800.0).cbrt();
    let (a, p_h) = (A_M * size, P_HERTZ_PA * size);
    let n = NODES;
    let dx = 4.0 * a / (n - 1) as f64;
    let (x_min, y_min) = (-2.5 * a, -2.0 * a);
    let dt = 4.0 * A_M / 128.0 / state.speed_m_s;
    let travelled = step as f64 * dt * state.speed_m_s;
    let mut frame = Frame {
        step,
        time_s: step as f64 * dt,
        stage: Stage::Passage,
        passages: travelled / (4.0 * A_M),
        nx: n,
        ny: n,
        x_min_m: x_min,
        dx_m: dx,
        y_min_m: y_min,
        dy_m: dx,
        a_m: a,
        b_m: a,
        p_hertz_pa: p_h,
        ..Frame::default()
    };
    for j in 0..n {
        for i in 0..n {
            let (x, y) = (x_min + i as f64 * dx, y_min + j as f64 * dx);
            let r = x.hypot(y) / a;
            let gap = if r > 1.0 {
                2e-6 * (r - 1.0).powf(1.5)
            } else {
                0.0
            };
            let horseshoe = if r > 0.75 && r < 1.05 && x > -0.3 * a {
                -6e-8
            } else {
                0.0
            };
            let (first, second) = (
                surface_1(state, x, travelled),
                surface_2(state, x, y, travelled),
            );
            let film = (2.3e-7 * state.speed_m_s.powf(0.67) + gap + horseshoe
                - 0.45 * (first + second))
                .max(2e-9);
            frame
                .pressure_pa
                .push(pressure(state, a, p_h, x, y, travelled) as f32);
            frame.film_m.push(film as f32);
            frame.roughness_1_m.push(first as f32);
            frame.roughness_2_m.push(second as f32);
            frame.traction_pa.push(0.0);
            frame.contact.push(u8::from(film <= 1.2e-8));
        }
    }
    frame.slice = Some(slice(&frame, state, travelled));
    frame.material_point = Some(point(&frame, state, travelled));
    frame.metrics = metrics(&frame, state);
    frame
}

fn slice(frame: &Frame, state: &State, travelled: f64) -> StressSlice {
    let depths: Vec<f64> = (0..24)
        .map(|k| 1.8 * frame.a_m * (f64::from(k) / 23.0).powf(1.5))
        .collect();
    let mut slice = StressSlice {
        depths_m: depths.into(),
        ..StressSlice::default()
    };
    for z in slice.depths_m.iter() {
        for i in 0..frame.nx {
            let x = (frame.x_min_m + i as f64 * frame.dx_m) / frame.a_m;
            let depth = z / frame.a_m;
            let bulk = 0.62 * (-(x * x) / 0.5).exp() * (depth / 0.48) * (1.0 - depth / 0.48).exp();
            let ripple = surface_1(state, x * frame.a_m, travelled)
                * 1.2e6
                * (-TAU * z / WAVE_M).exp()
                * (1.0 - x * x).max(0.0);
            slice
                .effective_pa
                .push((frame.p_hertz_pa * (bulk + ripple.abs())) as f32);
            slice
                .tau_xz_pa
                .push((0.2 * frame.p_hertz_pa * x * bulk) as f32);
        }
    }
    slice
}

fn point(frame: &Frame, state: &State, travelled: f64) -> MaterialPoint {
    let own = 1.0 - 0.5 * state.slide_roll;
    let path = 3.0 * frame.a_m;
    let x_m = (own * travelled).rem_euclid(path) - 1.5 * frame.a_m;
    let inside = f64::midpoint(x_m / frame.a_m, 1.0).clamp(0.0, 1.0);
    let n = 1.0 + 2.0 * frame.a_m / WAVE_M * state.slide_roll.abs() / own;
    let pressure_pa = pressure(state, frame.a_m, frame.p_hertz_pa, x_m, 0.0, travelled);
    let passed = (n * inside).floor();
    MaterialPoint {
        body: 1,
        x_m,
        depth_m: 2.5e-5,
        pressure_pa,
        effective_pa: 0.5 * pressure_pa,
        tau_xz_pa: 0.2 * pressure_pa * (TAU * x_m / WAVE_M).sin(),
        cycles_counted: passed,
        last_peak: (passed > 0.0).then(|| PassedPeak {
            x_m: frame.a_m * (2.0 * (passed - 0.3) / n - 1.0),
            pressure_pa,
        }),
        cycles_before: Some(n.floor()),
    }
}

fn metrics(frame: &Frame, state: &State) -> Metrics {
    let count = |own: f64| 1.0 + 2.0 * frame.a_m / WAVE_M * state.slide_roll.abs() / own;
    let n_1 = count(1.0 - 0.5 * state.slide_roll);
    let n_2 = count(1.0 + 0.5 * state.slide_roll);
    let worst = n_1.max(n_2);
    let rough = (state.amplitude_1_m + state.amplitude_2_m) / 4.0e-7;
    let wobble = 1.0 + 0.05 * (frame.step as f64 * 0.11).sin();
    let peak_factor = 0.32_f64.powf(rough) * wobble;
    let traction_factor = if state.slide_roll == 0.0 { 1.0 } else { 0.91 };
    let life_relative = peak_factor * traction_factor / worst;
    let (deepest, p_max) = (
        frame.film_m.iter().fold(f32::MAX, |least, h| least.min(*h)),
        frame
            .pressure_pa
            .iter()
            .fold(0.0_f32, |most, p| most.max(*p)),
    );
    let touching = frame.contact.iter().map(|c| f64::from(*c)).sum::<f64>();
    Metrics {
        converged: state.converged,
        residual: if state.converged { 3.1e-4 } else { 4.7e-2 },
        newton_iterations: 4,
        linear_iterations: 31,
        retries: if state.converged { 0 } else { 3 },
        slide_roll: state.slide_roll,
        slide_roll_target: state.slide_roll_target,
        entrainment_m_s: state.speed_m_s,
        load_n: state.load_n,
        load_target_n: state.load_target_n,
        amplitude_1_m: state.amplitude_1_m,
        amplitude_2_m: state.amplitude_2_m,
        p_max_pa: f64::from(p_max),
        h_central_m: 2.2e-7,
        h_min_m: f64::from(deepest),
        h_mean_m: 2.2e-7,
        lambda_ratio: (rough > 0.0).then(|| 1.08 / rough),
        film_to_roughness: None,
        contact_ratio: touching / (0.196 * frame.film_m.len() as f64),
        contact_load_ratio: 0.12,
        regime: LubricationRegime::Mixed,
        load_error: 2.4e-6,
        film_error: 1.2e-3,
        mass_error: 3.3e-5,
        overlap_m: 0.0,
        asked: [1e-3, 1e-2],
        friction_coefficient: 0.047,
        traction_max_pa: 4.7e7,
        sigma_eff_max_pa: Some(1.12e9),
        sigma_eff_max_depth_m: Some(0.46 * frame.a_m),
        sigma_eff_max_x_m: Some(0.05 * frame.a_m),
        life: Some(LifeEstimate {
            i_ref: 1.175e-3,
            i_mean: 4.1e-3,
            phases: 8,
            cycle_factor: 1.0 / worst,
            stress_factor: peak_factor * traction_factor,
            peak_factor,
            traction_factor,
            load_factor: 1.0,
            life_smooth: 1.0,
            life_relative,
            life_relative_low: 0.8 * life_relative,
            life_relative_high: 1.25 * life_relative,
            settled: state.settled,
            detail: LifeDetail {
                body: 1,
                basis_factor: 1.0,
                life_global: Some(life_relative),
                life_damage: Some(0.9 * peak_factor * traction_factor),
                ..LifeDetail::default()
            },
        }),
        n_body_1: Some(n_1),
        n_body_2: Some(n_2),
        n_counted_body_1: Some(n_1 - 0.2),
        n_counted_body_2: Some(n_2 + 0.1),
        ..Metrics::default()
    }
}

/// One period of the fixture: S = 0.5, so 3 crests of body 1 while 5 of body 2 pass.
pub(crate) fn settled(state: &State) -> Settled {
    let period_m = WAVE_M / (0.5 * state.slide_roll.abs()).max(0.25);
    let step_m = 4.0 * A_M / 128.0;
    let steps = (period_m / step_m).round() as u64;
    Settled {
        frames: (0..steps)
            .map(|step| Arc::new(frame(200 + step, state)))
            .collect(),
        period_s: steps as f64 * step_m / state.speed_m_s,
        state: None,
        is_last: true,
        ground: None,
    }
}

/// Unicode without colour: what is drawn shows in the characters.
pub(crate) fn plain() -> Theme {
    theme(ColorDepth::Mono, Glyphs::Unicode)
}

/// Plays so many steps of a synthetic run, a screen's frame apart.
pub(crate) fn play(app: &mut App, steps: std::ops::RangeInclusive<u64>, state: &State) {
    for step in steps {
        app.tick(Duration::from_millis(17 * step));
        app.take_status(status(step));
        app.take_frame(Arc::new(frame(step, state)));
    }
}

pub(crate) fn running(theme: Theme) -> App {
    let mut app = app(theme);
    play(&mut app, 1..=96, &State::default());
    app
}

pub(crate) fn buffer(app: &App, width: u16, height: u16) -> Buffer {
    let mut terminal = Terminal::new(TestBackend::new(width, height)).unwrap();
    terminal.draw(|frame| view::draw(app, frame)).unwrap();
    terminal.backend().buffer().clone()
}

pub(crate) fn text(app: &App, width: u16, height: u16) -> String {
    let buffer = buffer(app, width, height);
    let mut lines = Vec::new();
    for y in 0..height {
        let line: String = (0..width).map(|x| buffer[(x, y)].symbol()).collect();
        lines.push(line.trim_end().to_owned());
    }
    lines.join("\n")
}

pub(crate) fn sent(effects: &[Effect]) -> Vec<Command> {
    effects
        .iter()
        .filter_map(|effect| match effect {
            Effect::Send(command) => Some(command.clone()),
            _ => None,
        })
        .collect()
}

pub(crate) fn setup_of(scene: Scene) -> Setup {
    Setup {
        scene: Arc::new(scene),
        name: "demonstration".into(),
        load_n: 800.0,
        half_width_m: A_M,
        p_hertz_pa: P_HERTZ_PA,
        plan_text: String::new(),
        left_out: Vec::new(),
    }
}

/// The explorer's set-up of a scene as its plan has it, with nothing to run errands.
pub(crate) fn setup_planned(scene: &Scene, name: &str, plan: &Plan) -> Setup {
    Setup {
        name: name.into(),
        load_n: plan.force_n,
        half_width_m: plan.hertz.a_m,
        p_hertz_pa: plan.hertz.p_max_pa,
        ..setup_of(scene.clone())
    }
}

/// What a sweep would find at an S and a speed, all else as in the fixture.
pub(crate) fn found(slide_roll: f64, entrainment_m_s: f64, life: f64) -> Found {
    Found {
        at: CurvePoint {
            slide_roll,
            entrainment_m_s,
            load_n: 800.0,
            amplitude_m: [2.0e-7; 2],
        },
        choice: 0,
        began: CaseStart::Warm,
        life: Some([0.5 * life, life, 2.0 * life]),
        other: Some(0.4 * life),
        smooth: Some(4.0),
        friction: 0.03 + 0.01 / entrainment_m_s,
        lambda: Some(1.08 * entrainment_m_s.powf(0.67)),
    }
}

pub(crate) fn mouse(act: PointerAct, column: u16, row: u16) -> Pointer {
    Pointer { act, column, row }
}
