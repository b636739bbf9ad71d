//! Our side of the comparison with public codes : the same cases, error and CPU time.
//!
//! - *Hertz*: rigid sphere, free half-space, domain 3 a, `n` intervals a side; error of the greatest pressure and relative L2
//!   error of the field against the closed form. From a uniform pressure, to a tolerance.
//! - *Bisinusoidal*: gap `1 − cos cos` on a periodic surface at a mean pressure p̄ in p* = √2 π E* D/λ; greatest pressure and
//!   contact area against values on which three codes agree (`assets/reference/dry.csv`).
//! - *Subsurface*: greatest von Mises under a Hertz pressure, ν = 0.3, against the closed form.
//!
//! All rows of the surface are computed (no mirror), on one thread. CPU time is that of the working thread as the
//! system counts it, so that a busy machine does not spoil it; where the system does not tell, wall time stands in.
//!
//! `tests/peers/peers.py` runs [`table`] and puts those of the others beside it.
#![expect(clippy::unwrap_used, reason = "tests")]

use std::f64::consts::{PI, SQRT_2, TAU};
use std::time::Instant;

use asperity_engine::math::grid::{Grid, Symmetry};
use asperity_engine::physics::stress_exact::hertz_axis_maximum;
use asperity_engine::solve::dry::{Dry, DryProblem};
use asperity_engine::solve::film::Elastic;
use asperity_engine::solve::march::{Conditions, Flow, Guess, March, Shape};
use asperity_engine::solve::newton::{Iterate, NewtonReport, Tolerance, Verdict};
use asperity_engine::solve::reynolds::Medium;
use asperity_engine::solve::stress::{SliceOut, StressEngine, StressSpec};
use asperity_study::MarkdownTable;

/// Time that the runs of a case take together, s, and how many they are.
const ENOUGH_S: f64 = 0.5;
const FEWEST: f64 = 3.0;
const MOST: f64 = 100.0;

/// A clock of this thread's work, s.
struct CpuClock {
    wall: Instant,
    start_s: Option<f64>,
}

impl CpuClock {
    fn start() -> Self {
        Self {
            wall: Instant::now(),
            start_s: cpu_s(),
        }
    }

    fn seconds(&self) -> f64 {
        match self.start_s.zip(cpu_s()) {
            Some((start, now)) => now - start,
            None => self.wall.elapsed().as_secs_f64(),
        }
    }
}

/// CPU time of this thread, s; `None` where the system does not tell.
fn cpu_s() -> Option<f64> {
    let text = std::fs::read_to_string("/proc/thread-self/schedstat").ok()?;
    let nanoseconds: f64 = text.split_whitespace().next()?.parse().ok()?;
    Some(nanoseconds * 1e-9)
}

/// One case.
struct Row {
    case: String,
    n: usize,
    tolerance: f64,
    errors: [Option<f64>; 2],
    solve_s: f64,
    set_up_s: f64,
    iterations: u32,
}

fn tight(pressure: f64) -> Tolerance {
    Tolerance {
        pressure,
        film: f64::INFINITY,
        mass: f64::INFINITY,
        least_film: 0.0,
        load: 1e-8,
        max_iterations: 40,
    }
}

/// What was prepared and found last, CPU time of preparing and of solving.
///
/// The system's count lags by up to some milliseconds, so that many runs are timed as one: all with both, then all with
/// preparation alone.
fn timed<P, T>(prepare: impl Fn() -> P, solve: impl Fn(&mut P) -> T) -> (P, T, f64, f64) {
    let warm = Instant::now();
    let mut prepared = prepare();
    let mut out = solve(&mut prepared);
    let runs = (ENOUGH_S / warm.elapsed().as_secs_f64()).ceil();
    let runs = runs.clamp(FEWEST, MOST);
    let clock = CpuClock::start();
    for _ in 0..runs as u32 {
        prepared = prepare();
        out = solve(&mut prepared);
    }
    let both_s = clock.seconds() / runs;
    let clock = CpuClock::start();
    for _ in 0..runs as u32 {
        std::hint::black_box(prepare());
    }
    let set_up_s = clock.seconds() / runs;
    (prepared, out, set_up_s, (both_s - set_up_s).max(0.0))
}

fn converged(name: &str, report: &NewtonReport) -> Result<(), String> {
    if report.verdict == Verdict::Converged {
        Ok(())
    } else {
        Err(format!("{name}: {report:?}"))
    }
}

fn hertz(n: usize, tolerance: f64) -> Result<Row, String> {
    let conditions = Conditions {
        medium: &Medium::DRY,
        law: None,
        shift: &[],
        load: 2.0 * PI / 3.0,
        tolerance: tight(tolerance),
    };
    let prepare = || {
        let grid = Grid::new(n + 1, -1.5, 1.5, 1.5, Symmetry::General);
        let mut march = March::from_hertz(grid, &Shape::CIRCLE, 0.0, 1.0, Flow::Dry);
        march.state.history.pressure_1.fill(0.0);
        march
    };
    let solve = |march: &mut March| march.attempt(&conditions, 1.0, Guess::Last);
    let (mut march, report, set_up_s, solve_s) = timed(prepare, solve);
    converged("Hertz", &report)?;
    march.commit(1.0);
    let (grid, p) = (&march.solver.grid, &march.state.pressure);
    let exact = |at: usize| {
        let r2 = grid.x(at % grid.nx).powi(2) + grid.y(at / grid.nx).powi(2);
        (1.0 - r2).max(0.0).sqrt()
    };
    let off = grid.integrate(|at| (p[at] - exact(at)).powi(2));
    let l2 = (off / grid.integrate(|at| exact(at).powi(2))).sqrt();
    let greatest = p.iter().copied().fold(0.0, f64::max);
    Ok(Row {
        case: "hertz".to_owned(),
        n,
        tolerance,
        errors: [Some((greatest - 1.0).abs()), Some(l2)],
        solve_s,
        set_up_s,
        iterations: report.linear_iterations,
    })
}

/// Mean pressure over p*, greatest pressure over p* and contact area at 512².
const BISINUSOIDAL: [(f64, f64, f64); 3] = [
    (0.05, 0.70940, 0.11335),
    (0.2, 1.09553, 0.34644),
    (0.5, 1.47934, 0.70510),
];

/// Deflection, solver, pressure, gap, H0.
type Periodic = (Elastic, Dry, Vec<f64>, Vec<f64>, f64);

fn bisinusoidal(
    n: usize,
    tolerance: f64,
    (mean, p_max, area): (f64, f64, f64),
) -> Result<Row, String> {
    let grid = Grid::new(n + 1, 0.0, 1.0, 0.5, Symmetry::General);
    let nodes = grid.nx;
    let wave = |at: usize| (TAU * grid.x(at % nodes)).cos() * (TAU * grid.y(at / nodes)).cos();
    let gap: Vec<f64> = (0..grid.len()).map(|at| -wave(at)).collect();
    let prepare = || {
        let elastic = Elastic::periodic(&grid, SQRT_2);
        let dry = Dry::new(&grid, &elastic);
        let zero = vec![0.0; grid.len()];
        (elastic, dry, zero.clone(), zero, 0.0)
    };
    let solve = |prepared: &mut Periodic| {
        let (elastic, dry, p, h, h0) = prepared;
        let problem = DryProblem {
            grid: &grid,
            gap: &gap,
            load: mean,
            tolerance: tight(tolerance),
        };
        dry.solve(elastic, &problem, &mut Iterate { p, h, h0 })
    };
    let ((_, _, p, ..), report, set_up_s, solve_s) = timed(prepare, solve);
    converged("bisinusoidal", &report)?;
    let greatest = p.iter().copied().fold(0.0, f64::max);
    let loaded = p.iter().filter(|p| **p > 0.0).count() as f64 / (n * n) as f64;
    Ok(Row {
        case: format!("bisinusoidal {mean}"),
        n,
        tolerance,
        errors: [
            Some((greatest / p_max - 1.0).abs()),
            Some((loaded / area - 1.0).abs()),
        ],
        solve_s,
        set_up_s,
        iterations: report.linear_iterations,
    })
}

fn subsurface(n: usize, depths: usize) -> Result<Row, String> {
    let d = 4.0 / n as f64;
    let mut spec = StressSpec::new(
        (n + 1, n + 1),
        (d, d),
        0.3,
        (depths, 3.0),
        Symmetry::General,
    );
    spec.x_first = -2.0;
    let p: Vec<f32> = (0..spec.nx * spec.ny)
        .map(|at| {
            let (x, y) = ((at % spec.nx) as f64, (at / spec.nx) as f64);
            let r2 = (d * x - 2.0).powi(2) + (d * y - 2.0).powi(2);
            (1.0 - r2).max(0.0).sqrt() as f32
        })
        .collect();
    let prepare = || StressEngine::new(&spec);
    let solve = |engine: &mut Result<StressEngine, _>| {
        let engine = engine.as_mut().ok()?;
        engine.load(&p, None);
        Some(engine.volume(10.0).normal.peak.value)
    };
    let (engine, sampled, set_up_s, solve_s) = timed(prepare, solve);
    let mut engine = engine.map_err(|error| error.to_string())?;
    let mut slice = SliceOut::new(engine.spec());
    engine.slice(&mut slice);
    let (_, exact) = hertz_axis_maximum(0.3);
    let sampled = sampled.unwrap_or(f64::NAN);
    Ok(Row {
        case: format!("subsurface, {depths} depths"),
        n,
        tolerance: spec.decay,
        // Between the depths, and at them as the peer gives it.
        errors: [
            Some((slice.peak.value / exact - 1.0).abs()),
            Some((sampled / exact - 1.0).abs()),
        ],
        solve_s,
        set_up_s,
        iterations: 1,
    })
}

/// The cases on one thread: lines of a table whose columns are those of `peers.py`.
fn cases(sizes: &[usize]) -> MarkdownTable {
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(1)
        .build()
        .unwrap();
    let of_size = |n: usize| {
        let mut rows = vec![hertz(n, 1e-6), hertz(n, 1e-8)];
        rows.extend(BISINUSOIDAL.map(|values| bisinusoidal(n, 1e-8, values)));
        if n <= 256 {
            rows.push(subsurface(n, 32));
        }
        rows
    };
    let rows = sizes.iter().flat_map(|&n| pool.install(|| of_size(n)));
    let mut table = MarkdownTable::new(&[
        "case",
        "code",
        "n",
        "tolerance",
        "error_1",
        "error_2",
        "solve_cpu_s",
        "setup_cpu_s",
        "iterations",
    ]);
    let shown = |error: Option<f64>| error.map_or(String::new(), |error| format!("{error:.3e}"));
    for row in rows.map(Result::unwrap) {
        table.rows.push(vec![
            row.case,
            "asperity".to_owned(),
            row.n.to_string(),
            format!("{:e}", row.tolerance),
            shown(row.errors[0]),
            shown(row.errors[1]),
            format!("{:.5}", row.solve_s),
            format!("{:.5}", row.set_up_s),
            row.iterations.to_string(),
        ]);
    }
    table
}

#[test]
fn our_side_of_the_peers_is_as_near_as_they_are() {
    let table = cases(&[128]);
    println!("{}", table.csv());
    let column = |name: &str| {
        let at = table.columns.iter().position(|column| *column == name);
        at.unwrap()
    };
    let number = |row: &[String], name: &str| -> f64 { row[column(name)].parse().unwrap() };
    // dry.csv: at 128² the public codes lie 0.0020 % and 0.342 % off.
    let mut hertz = table.rows.iter().filter(|row| row[0] == "hertz");
    assert!(hertz.all(|row| number(row, "error_1") < 2.5e-5 && number(row, "error_2") < 3.45e-3));
    let mut waves = table
        .rows
        .iter()
        .filter(|row| row[0].starts_with("bisinusoidal"));
    assert!(waves.all(|row| number(row, "error_1") < 1e-3 && number(row, "iterations") < 60.0));
}

/// Writes the table to the file that `ASPERITY_PEERS` names: the sizes up to 512, or as many intervals as
/// `ASPERITY_PEERS_N` says.
#[test]
#[ignore = "times, for tests/peers/peers.py"]
fn table() {
    let only = std::env::var("ASPERITY_PEERS_N").map(|n| vec![n.parse().unwrap()]);
    let sizes = only.unwrap_or_else(|_| vec![128, 256, 512]);
    let path = std::env::var_os("ASPERITY_PEERS").unwrap();
    std::fs::write(path, cases(&sizes).csv()).unwrap();
}
