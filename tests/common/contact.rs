//! A contact given by Moes' groups, marched by the solver alone: what the tables are made of.

use std::f64::consts::{PI, TAU};

use super::workers::alone;
use asperity_engine::math::grid::{Grid, Symmetry};
use asperity_engine::physics::fluid::{Density, Viscosity};
use asperity_engine::physics::groups::PointContact;
use asperity_engine::solve::march::{Conditions, Flow, Guess, March, Shape};
use asperity_engine::solve::newton::{
    Iterate, Newton, NewtonReport, Problem, Sheared, Tolerance, Verdict,
};
use asperity_engine::solve::reynolds::Medium;

/// Fluids of the reference tables.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Fluid {
    BarusIncompressible,
    /// η0 = 0.04 Pa s, α = 2.2e-8 1/Pa.
    RoelandsDowsonHigginson,
    /// The same with the density law in the round numbers of Venner and Lubrecht.
    RoelandsVennerLubrecht,
}

impl Fluid {
    /// The fluid of α p_h = `alpha_p` without sliding, with the group `lambda`.
    pub(crate) fn medium(self, alpha_p: f64, lambda: f64) -> Medium {
        let alpha = 2.2e-8;
        let p_hertz = alpha_p / alpha;
        let (barus, roelands) = (
            Viscosity::barus(alpha, p_hertz),
            Viscosity::roelands(0.04, alpha, p_hertz),
        );
        let p_hertz_gpa = p_hertz * 1e-9;
        let (viscosity, density) = match self {
            Self::BarusIncompressible => (barus, Density::Incompressible),
            Self::RoelandsDowsonHigginson => (roelands, Density::DowsonHigginson { p_hertz_gpa }),
            Self::RoelandsVennerLubrecht => (roelands, Density::VennerLubrecht { p_hertz_gpa }),
        };
        Medium::newtonian(viscosity, density, lambda)
    }
}

/// No oil at all.
pub(crate) const DRY: Medium = Medium::DRY;

/// Gap `−cos cos` over one wave of length 1, of Johnson, Greenwood and Higginson (1985).
pub(crate) fn bisinusoidal_gap(grid: &Grid) -> Vec<f64> {
    let wave = |n: usize| (TAU * grid.x(n % grid.nx)).cos() * (TAU * grid.y(n / grid.nx)).cos();
    (0..grid.len()).map(|n| -wave(n)).collect()
}

/// A circular contact.
pub(crate) struct Case {
    pub(crate) medium: Medium,
    pub(crate) lambda: f64,
    pub(crate) domain: (f64, f64, f64),
}

pub(crate) const CIRCLE: Shape = Shape::CIRCLE;

pub(crate) const LOAD: f64 = 2.0 * PI / 3.0;

pub(crate) const TOLERANCE: Tolerance = Tolerance {
    pressure: 1e-4,
    film: 1e-4,
    mass: 1e-4,
    least_film: 0.0,
    load: 1e-5,
    max_iterations: 20,
};

/// A step under the unit load.
pub(crate) fn conditions(medium: &Medium, tolerance: Tolerance) -> Conditions<'_> {
    Conditions {
        medium,
        law: None,
        shift: &[],
        load: LOAD,
        tolerance,
    }
}

impl Case {
    /// Moes M, L: λ = (128π³/(3M⁴))^{1/3}, α p_h = (L/π)(3M/2)^{1/3}.
    pub(crate) fn moes(m: f64, l: f64, fluid: Fluid, domain: (f64, f64, f64)) -> Self {
        let lambda = (128.0 * PI.powi(3) / (3.0 * m.powi(4))).cbrt();
        Self {
            medium: fluid.medium(l / PI * (1.5 * m).cbrt(), lambda),
            lambda,
            domain,
        }
    }

    /// Film in Moes units.
    pub(crate) fn film(&self, h: f64) -> f64 {
        h * (6.0 * PI / self.lambda).sqrt()
    }

    pub(crate) fn grid(&self, nodes: usize) -> Grid {
        let (x_min, x_max, y_half) = self.domain;
        Grid::new(nodes, x_min, x_max, y_half, Symmetry::MirrorY)
    }

    /// The same for an operating point in SI (circular; Roelands, Dowson and Higginson).
    pub(crate) fn of_point(point: &PointContact, domain: (f64, f64, f64)) -> Self {
        let hertz = point.hertz();
        let p_hertz = hertz.p_max_pa;
        let lambda = 12.0 * point.entrainment_m_s * point.viscosity_pa_s * point.rx_m.powi(2)
            / (hertz.a_m.powi(3) * p_hertz);
        let p_hertz_gpa = p_hertz * 1e-9;
        let density = Density::DowsonHigginson { p_hertz_gpa };
        let viscosity = Viscosity::roelands(point.viscosity_pa_s, point.alpha_per_pa, p_hertz);
        Self {
            medium: Medium::newtonian(viscosity, density, lambda),
            lambda,
            domain,
        }
    }

    /// As [`Case::steady`] from Hertz, for thin films: the finer grids are flushed over 3 a only (from 1.5 a
    /// ahead of the contact to 1.5 a behind it), and a step that does not converge goes down the ladder of the
    /// simulation; every rung that was used is counted by name.
    pub(crate) fn steady_by_ladder(
        &self,
        nodes: usize,
        each: impl FnMut(&March) + Send,
    ) -> (March, Ladder) {
        alone(|| self.by_ladder(nodes, each))
    }

    fn by_ladder(&self, nodes: usize, mut each: impl FnMut(&March)) -> (March, Ladder) {
        let mut ladder = Ladder::default();
        let guess = 1.2 * self.lambda.powf(0.67);
        let mut march = March::from_hertz(self.grid(65), &CIRCLE, guess, 1.0, Flow::Film);
        let mut way = self.domain.1 - self.domain.0;
        loop {
            let steps = (way / march.solver.grid.dx) as usize;
            for _ in 0..steps {
                ladder.step(self, &mut march);
            }
            each(&march);
            if march.solver.grid.nx >= nodes {
                return (march, ladder);
            }
            let finer = self.grid(2 * (march.solver.grid.nx - 1) + 1);
            march = March::refined(&march, finer, &CIRCLE, 1.0, Flow::Film);
            way = 3.0;
        }
    }

    /// The steady smooth contact on `nodes` per side, through 65², 129² ...; `each` sees every grid's.
    pub(crate) fn steady(&self, nodes: usize, each: impl FnMut(&March)) -> March {
        let guess = 1.2 * self.lambda.powf(0.67);
        let step = |march: &mut March| {
            self.step(march, 1.0);
        };
        steady(|nodes| self.grid(nodes), &CIRCLE, guess, nodes, step, each)
    }

    /// One committed step that must converge.
    pub(crate) fn step(&self, march: &mut March, nodes: f64) -> NewtonReport {
        converged(march, &conditions(&self.medium, TOLERANCE), nodes)
    }
}

/// The steady smooth contact from Hertz, on 65 nodes a side and on ever finer grids up to `finest`. `step` goes on by a
/// node; as many steps as the domain has nodes end the start-up. `each` sees what every grid ends with.
pub(crate) fn steady(
    grid: impl Fn(usize) -> Grid,
    shape: &Shape,
    guess: f64,
    finest: usize,
    step: impl Fn(&mut March),
    mut each: impl FnMut(&March),
) -> March {
    let mut march = March::from_hertz(grid(65), shape, guess, 1.0, Flow::Film);
    loop {
        let nx = march.solver.grid.nx;
        for _ in 1..nx {
            step(&mut march);
        }
        each(&march);
        if nx >= finest {
            return march;
        }
        march = March::refined(&march, grid(2 * (nx - 1) + 1), shape, 1.0, Flow::Film);
    }
}

/// One committed step that must converge, with no pressure below zero and a film everywhere.
pub(crate) fn converged(
    march: &mut March,
    conditions: &Conditions<'_>,
    nodes: f64,
) -> NewtonReport {
    let report = march.attempt(conditions, nodes, Guess::Extrapolated);
    assert_eq!(report.verdict, Verdict::Converged, "{report:?}");
    march.commit(nodes);
    assert!(march.state.pressure.iter().all(|&p| p >= 0.0));
    assert!(march.state.film.iter().all(|&h| h > 0.0 && h.is_finite()));
    report
}

/// The dry contact of a march by Newton's method, from a pressure, a gap and an approach that become its answer.
pub(crate) fn by_newton(
    march: &March,
    newton: &mut Newton,
    sheared: Option<Sheared<'_>>,
    tolerance: Tolerance,
    answer: (&mut [f64], &mut [f64], &mut f64),
) -> NewtonReport {
    let grid = &march.solver.grid;
    let zero = vec![0.0; grid.len()];
    let (p, h, h0) = answer;
    newton.solve(
        &Problem {
            grid,
            medium: &DRY,
            sheared,
            gap: &march.solver.gap,
            c_star: &zero,
            s: &zero,
            load: LOAD,
            tolerance,
        },
        &mut Iterate { p, h, h0 },
    )
}

/// How often each rung was used.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(crate) struct Ladder {
    pub(crate) first_try: u32,
    pub(crate) from_last_pressure: u32,
    pub(crate) halved: u32,
    pub(crate) safely: u32,
    pub(crate) not_converged: u32,
}

impl Ladder {
    /// One committed node of travel: extrapolated guess, last pressure as guess, halves, backward Euler.
    fn step(&mut self, case: &Case, march: &mut March) {
        let conditions = conditions(&case.medium, TOLERANCE);
        let converged = |report: NewtonReport| report.verdict == Verdict::Converged;
        if converged(march.attempt(&conditions, 1.0, Guess::Extrapolated)) {
            self.first_try += 1;
            return march.commit(1.0);
        }
        if converged(march.attempt(&conditions, 1.0, Guess::Last)) {
            self.from_last_pressure += 1;
            return march.commit(1.0);
        }
        self.halved += 1;
        for _ in 0..2 {
            if !converged(march.attempt(&conditions, 0.5, Guess::Last)) {
                let report = march.attempt_safely(&conditions, 0.5);
                self.safely += 1;
                if report.verdict != Verdict::Converged {
                    self.not_converged += 1;
                    println!("not converged: {report:?}");
                }
            }
            march.commit(0.5);
        }
    }
}

/// Rows of a reference file: named columns, the first line says where they come from.
pub(crate) struct Table {
    names: Vec<String>,
    rows: Vec<Vec<String>>,
}

impl Table {
    pub(crate) fn read(name: &str) -> Self {
        let path = format!(
            "{}/../../assets/reference/{name}",
            env!("CARGO_MANIFEST_DIR")
        );
        let text = std::fs::read_to_string(&path).unwrap_or_else(|error| panic!("{path}: {error}"));
        let mut lines = text
            .lines()
            .filter(|line| !line.starts_with('#'))
            .map(|line| line.split(',').map(str::to_owned).collect::<Vec<_>>());
        let names = lines.next().expect("a line of names");
        let rows: Vec<_> = lines.collect();
        assert!(rows.iter().all(|row| row.len() == names.len()), "{path}");
        Self { names, rows }
    }

    /// Only the rows that `wanted` picks.
    pub(crate) fn keep(&mut self, wanted: impl Fn(&Row) -> bool) {
        let names = &self.names;
        self.rows.retain(|cells| wanted(&Row { names, cells }));
    }

    pub(crate) fn rows(&self) -> impl Iterator<Item = Row<'_>> {
        self.rows.iter().map(|cells| Row {
            names: &self.names,
            cells,
        })
    }
}

/// One row of it.
#[derive(Clone, Copy)]
pub(crate) struct Row<'a> {
    names: &'a [String],
    cells: &'a [String],
}

impl<'a> Row<'a> {
    pub(crate) fn text(&self, name: &str) -> &'a str {
        let column = self.names.iter().position(|n| n == name);
        &self.cells[column.unwrap_or_else(|| panic!("no column {name}"))]
    }

    /// A number; `None`: the cell is empty.
    pub(crate) fn get(&self, name: &str) -> Option<f64> {
        let text = self.text(name);
        (!text.is_empty()).then(|| text.parse().unwrap_or_else(|_| panic!("{name}: {text}")))
    }

    pub(crate) fn number(&self, name: &str) -> f64 {
        self.get(name).unwrap_or_else(|| panic!("{name} is empty"))
    }
}

/// H at the origin.
pub(crate) fn central(march: &March) -> f64 {
    let grid = &march.solver.grid;
    let i = (-grid.x_min / grid.dx).round() as usize;
    assert!(grid.x(i).abs() < 1e-12, "the origin is a node");
    march.state.film[grid.axis_row() * grid.nx + i]
}

/// Least H inside r < 1.1, by a parabola through the lowest node along y and x.
pub(crate) fn minimum(march: &March) -> f64 {
    let grid = &march.solver.grid;
    let film = &march.state.film;
    let mut best = (f64::INFINITY, 0, 0);
    for j in grid.interior_rows() {
        for i in 1..grid.nx - 1 {
            let inside = grid.x(i).hypot(grid.y(j)) < 1.1;
            let h = film[j * grid.nx + i];
            if inside && h < best.0 {
                best = (h, i, j);
            }
        }
    }
    let (h, i, j) = best;
    let vertex = |low: f64, high: f64| {
        let curvature = low - 2.0 * h + high;
        if curvature > 0.0 {
            (low - high).powi(2) / (8.0 * curvature)
        } else {
            0.0
        }
    };
    let row = j * grid.nx;
    let south = grid.row_below(j) * grid.nx + i;
    h - vertex(film[row + i - 1], film[row + i + 1]) - vertex(film[south], film[row + grid.nx + i])
}
