//! The plan as text: what `asperity check` prints.

use std::fmt;

use super::{LINE_ROWS, LifePlan, OtherFilms, Plan, Symmetry, TimeDependence, WavePlan};
use crate::math::number::{fixed, length};
use crate::scene::{ContactKind, CycleBasis, EyringFlow, Spread, Warming};

impl fmt::Display for Plan {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if !self.title.is_empty() {
            writeln!(f, "{}\n", self.title)?;
        }
        self.write_operating_point(f)?;
        self.write_grid(f)?;
        writeln!(f, "\nComputed")?;
        for line in self.computed() {
            writeln!(f, "  {line}")?;
        }
        writeln!(f, "\nNot modelled or not needed")?;
        for item in &self.left_out {
            writeln!(f, "  {:<24}{}", item.stage, item.why)?;
        }
        let (stage, elastic) = match (self.yielding, self.wear) {
            (Some(_), Some(_)) => ("deep yield", "elastic below the surface"),
            (Some(_), None) => ("wear, deep yield", "elastic below the surface"),
            (None, Some(_)) => ("yield", "elastic"),
            (None, None) => ("wear, yield", "elastic"),
        };
        let heat = match self.warming {
            Warming::None => "heat, ",
            Warming::Surfaces | Warming::SurfacesAndOil => "",
        };
        let isothermal = self.warming.words();
        let stage = format!("{heat}{stage}");
        writeln!(
            f,
            "  {stage:<24}not in the model: {isothermal}, {elastic}, crack initiation only"
        )?;
        if !self.warnings.is_empty() {
            writeln!(f, "\nCautions")?;
            for warning in &self.warnings {
                writeln!(f, "  {warning}")?;
            }
        }
        writeln!(
            f,
            "\nEstimate    {} of memory, {} on one core",
            size(self.cost.memory_bytes),
            self.cost.time_text()
        )
    }
}

impl Plan {
    fn write_operating_point(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let hertz = &self.hertz;
        match self.kind {
            ContactKind::Line => writeln!(
                f,
                "Contact     line: half-width {} µm, uniform along y; Hertz pressure {:.3} GPa; load {} N/m",
                fixed(hertz.a_m * 1e6, 1),
                hertz.p_max_pa * 1e-9,
                significant(self.force_n)
            )?,
            ContactKind::Point => writeln!(
                f,
                "Contact     {}: a {} µm, b {} µm; Hertz pressure {:.3} GPa; load {} N; approach {} µm",
                if (hertz.ellipticity() - 1.0).abs() < 1e-9 {
                    "circular"
                } else {
                    "elliptical"
                },
                fixed(hertz.a_m * 1e6, 1),
                fixed(hertz.b_m * 1e6, 1),
                hertz.p_max_pa * 1e-9,
                significant(self.force_n),
                fixed(hertz.approach_m * 1e6, 2)
            )?,
        }
        let [u_1, u_2] = self.speeds_m_s;
        writeln!(
            f,
            "Motion      S = (U2 - U1)/U = {}; U1 {} m/s, U2 {} m/s",
            self.slide_roll,
            significant(u_1),
            significant(u_2)
        )?;
        if let Some(oil) = &self.oil_line {
            writeln!(f, "Oil         {oil}")?;
        }
        self.write_film(f)?;
        for (index, wave) in self.waves.iter().enumerate() {
            if let Some(wave) = wave {
                writeln!(f, "Body {}      {}", index + 1, wave_text(wave))?;
            }
            for (n, line) in self.relief_lines[index].iter().enumerate() {
                let name = if n == 0 { "Its map" } else { "" };
                writeln!(f, "{name:<12}{line}")?;
            }
        }
        Ok(())
    }

    fn write_film(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Some(film) = &self.film else {
            return Ok(());
        };
        let m = film.groups.m;
        write!(
            f,
            "Film        M {}, L {:.2}, αp_h {:.1}; smooth by formula: central {} nm ",
            if m < 10.0 {
                significant(m)
            } else {
                m.round().to_string()
            },
            film.groups.l,
            film.groups.alpha_p_hertz,
            fixed(film.central_m * 1e9, 1)
        )?;
        let source = match film.others {
            OtherFilms::HamrockDowson {
                central_m,
                minimum_m,
            } => {
                writeln!(
                    f,
                    "(Nijenbanning), {} nm (Hamrock-Dowson), minimum {} nm (Hamrock-Dowson)",
                    fixed(central_m * 1e9, 1),
                    fixed(minimum_m * 1e9, 1)
                )?;
                "Hamrock-Dowson"
            }
            OtherFilms::DowsonHigginson { minimum_m } => {
                writeln!(
                    f,
                    "(Moes), minimum {} nm (Dowson-Higginson)",
                    fixed(minimum_m * 1e9, 1)
                )?;
                "Moes"
            }
        };
        if let Some(ratio) = film.lambda_ratio {
            writeln!(
                f,
                "Lambda      {ratio:.2} = central film ({source})/composite root-mean-square roughness"
            )?;
        }
        Ok(())
    }

    fn write_grid(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let domain = &self.domain;
        match self.kind {
            ContactKind::Line => writeln!(
                f,
                "Grid        {n} nodes, x {} a to {} a; dx {} µm; drawn as {LINE_ROWS} equal rows",
                significant(domain.x_min_a),
                significant(domain.x_max_a),
                fixed(self.dx_m * 1e6, 2),
                n = domain.nodes
            )?,
            ContactKind::Point => writeln!(
                f,
                "Grid        {n} x {n} nodes, x {} a to {} a, y ±{} b; dx {} µm, dy {} µm",
                significant(domain.x_min_a),
                significant(domain.x_max_a),
                significant(domain.y_half_b),
                fixed(self.dx_m * 1e6, 2),
                fixed(self.dy_m * 1e6, 2),
                n = domain.nodes
            )?,
        }
        match self.time_dependence {
            TimeDependence::Steady { .. } => writeln!(f, "Time        steady: one solution"),
            TimeDependence::Transient => {
                writeln!(
                    f,
                    "Time        {} steps of {:.3e} s after the start-up: {:.3e} s, {:.2} passages of 4 a",
                    self.steps,
                    self.dt_s,
                    self.steps as f64 * self.dt_s,
                    self.steps as f64 / self.steps_per_passage as f64
                )?;
                if self.until_settled {
                    writeln!(
                        f,
                        "            at most: after one passage until life and waves' period have settled and damage maps are whole (time.passages says how many)"
                    )?;
                }
                if let Some(tolerance) = self.step_tolerance {
                    writeln!(
                        f,
                        "            adaptive: each as long as the film allows, at most {} % of error in one crossing",
                        significant(100.0 * tolerance)
                    )?;
                }
                Ok(())
            }
        }
    }

    /// The stages that are computed, one line each.
    fn computed(&self) -> Vec<String> {
        let rows = match self.symmetry {
            Symmetry::MirrorY => "half of the rows",
            Symmetry::General => "all rows",
            Symmetry::Line => "one row",
        };
        let mut lines = vec![match self.film {
            Some(film) if film.flows() => {
                format!("mixed lubrication: flow, film and contact together ({rows})")
            }
            _ => format!("dry contact ({rows})"),
        }];
        let film = self.film.filter(super::FilmPlan::flows);
        if let Some(flow) = film.and_then(|film| film.eyring_flow) {
            lines.push(flow_text(flow).to_owned());
        }
        lines.push("traction on both bodies, friction coefficient".to_owned());
        if let Some(traction) = self.traction_deflection {
            lines.push(format!(
                "deflection by traction: compliances differ by {:.2e} 1/Pa",
                traction.mismatch_per_pa
            ));
        }
        if let Some((hardness_pa, flows)) = self.yielding {
            lines.push(yielding_text(hardness_pa, flows));
        }
        if self.warming != Warming::None {
            let oil = match self.warming {
                Warming::SurfacesAndOil => "; film and friction of the warm oil",
                Warming::None | Warming::Surfaces => "",
            };
            let surfaces = "flash temperature of both surfaces by moving sources, every step";
            lines.push(format!("{surfaces}{oil}"));
        }
        if let Some(wear) = self.wear {
            lines.push(wear.text());
        }
        if let Some(stress) = self.stress {
            lines.push(format!(
                "{} in the plane y = 0, {} depths down to {} µm, every step",
                match self.kind {
                    ContactKind::Point => "stress",
                    ContactKind::Line => "plane-strain stress",
                },
                stress.depths,
                fixed(stress.depth_max_m * 1e6, 0)
            ));
        }
        if let Some(life) = &self.life {
            lines.extend(life_lines(life, self.kind));
        }
        if let Some(record) = self.record {
            lines.push(format!(
                "recording: scalars {}, fields {} ({} pictures, about {} of at most {})",
                every(record.scalars_every_steps),
                every(record.every_steps),
                record.frames,
                size(record.bytes),
                size(record.budget_bytes)
            ));
        }
        lines
    }
}

/// What is computed for life.
fn life_lines(life: &LifePlan, kind: ContactKind) -> Vec<String> {
    let asked = &life.asked;
    let what = match kind {
        ContactKind::Point if asked.volumes() => "stress in the whole volume of both bodies",
        ContactKind::Point => "stress below y = 0 of both bodies",
        ContactKind::Line => "the life integral over x and z of both bodies",
    };
    let mut lines = vec![
        format!(
            "{what} and relative life, {} ({} phases in 4 a)",
            every(life.volume_every_steps),
            life.phases_per_passage
        ),
        format!(
            "life by {} of {}; cycles: {}; {}",
            asked.model.name(),
            asked.measure.name(),
            cycles_text(asked.cycles),
            match asked.cycles {
                CycleBasis::Damage => "greatest stress that each material point meets",
                CycleBasis::Global | CycleBasis::Peaks => "mean of snapshots",
            }
        ),
    ];
    if asked.spread == Spread::Models {
        lines.push("the other life models too, for their spread".to_owned());
    }
    let bodies = match asked.maps {
        [true, true] => "both bodies",
        [true, false] => "body 1",
        [false, true] => "body 2",
        [false, false] => return lines,
    };
    lines.push(format!(
        "damage of {bodies} over depth and along the surface, by material points on y = 0"
    ));
    lines
}

/// What flows at which pressure.
fn yielding_text(hardness_pa: f64, flows: [bool; 2]) -> String {
    let who = match flows {
        [true, false] => "body 1, the softer, yields",
        [false, true] => "body 2, the softer, yields",
        _ => "both bodies yield, half each,",
    };
    format!(
        "pressure limited to {:.2} GPa: beyond it {who} for good",
        hardness_pa * 1e-9
    )
}

/// What the pressure's flow meets in Eyring oil, in words.
fn flow_text(flow: EyringFlow) -> &'static str {
    match flow {
        EyringFlow::Secant => {
            "Eyring oil: flow by one effective viscosity in both directions (secant)"
        }
        EyringFlow::AlongAcross => {
            "Eyring oil: flow along the sliding as it is (tangent, less on steep crests), across by the secant"
        }
    }
}

fn every(steps: u64) -> String {
    match steps {
        1 => "every step".to_owned(),
        n => format!("every {n} steps"),
    }
}

/// A cycle basis in words.
fn cycles_text(cycles: CycleBasis) -> &'static str {
    match cycles {
        CycleBasis::Damage => "counted by depth, each by its damage, in those of the faster body",
        CycleBasis::Global => "one n for the volume, every contact a whole cycle",
        CycleBasis::Peaks => "counted by depth, by peaks",
    }
}

fn wave_text(wave: &WavePlan) -> String {
    let along = |nodes: f64| {
        if nodes.is_finite() {
            format!("{nodes:.1} nodes per wave")
        } else {
            "no wave".to_owned()
        }
    };
    format!(
        "amplitude {}; along x {}, along y {}",
        length(wave.amplitude_m),
        along(wave.nodes[0]),
        along(wave.nodes[1])
    )
}

/// Four significant digits without an exponent.
fn significant(value: f64) -> String {
    let rounded = format!("{value:.3e}").parse::<f64>();
    rounded.map_or_else(|_| value.to_string(), |rounded| rounded.to_string())
}

fn size(bytes: u64) -> String {
    let mega = bytes as f64 * 1e-6;
    if mega >= 1000.0 {
        format!("{:.1} GB", mega * 1e-3)
    } else if mega >= 10.0 {
        format!("{mega:.0} MB")
    } else {
        format!("{mega:.1} MB")
    }
}

pub(super) fn duration(seconds: f64) -> String {
    if seconds < 100.0 {
        format!("{seconds:.0} s")
    } else if seconds < 6000.0 {
        format!("{:.0} min", seconds / 60.0)
    } else {
        format!("{:.1} h", seconds / 3600.0)
    }
}
