//! What a reader must know before trusting a result: a code for scripts, a sentence with numbers for people.
//!
//! ```text
//! beyond_yield   p_max > H or σ_eff > Y of the body that carries less, as far as it is known        greatest of the last passage
//! still_yielding  more than 0.1 % of all flow of surfaces in the last passage
//! amplitude_doubtful  0 < A < 0.1 nm, or A > a/10                              at the knobs' present values
//! map_doubtful   the best plane, or outlying pixels, of a height map are left in
//! mesh_film      error of the smooth central film by the mesh > 5 %             at the knobs' present values
//! short_domain   the same by the edges of the domain > 1 %                      likewise
//! long_step, coarse_wave, coarse_convected_wave, coarse_counting, crests_at_edge, shallow_stress, thermal_unknown
//!                what the plan warns of                                         at the knobs' present values
//! late_event     an event of the scene after the end of its run: of a run, not of a step
//! map_not_seen   a height map of which a part has not passed yet
//! one_sample     a made surface: its seed and its cut-off move the life
//! oil_law        mean shear stress of the film > Eyring's, of oil that flows        likewise
//! crests_not_felt  crests that press less than a thousandth of Hertz's pressure, or of which material points count less than
//!                  a tenth, of a count above 1
//! no_reference   the smooth contact below the fatigue limit
//! phase_locked   S = 0 between two rough bodies, or so little that crests do not meet in all ways
//! model_range    greatest over least life of the choices > 2
//! above_smooth   the whole band of life above 1.01
//! ```
//! One list for the screen, the summary and the report text. It is made only when asked for.

use serde::{Deserialize, Serialize};

use super::grounds::ReferenceLife;
use super::{Frame, Grounds, LifeEstimate, Metrics, Rhythm};
use crate::math::number::{fixed, length, sig};
use crate::physics::felt::{FELT, felt_where_counted};
use crate::physics::strength::Strength;
use crate::plan::{EDGES_WORTH_A_WORD, KnobsAt, MOLECULE_M, Plan, Warning};
use crate::scene::{Doubt, StressMeasure};

/// Kind of caution, as scripts read it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum CautionCode {
    /// A step did not converge.
    NotConverged,
    /// Pressure or stress beyond what the material carries elastically.
    BeyondYield,
    /// Surfaces still flow at their hardness.
    StillYielding,
    /// A surface lower than an atom, or as high as the contact is wide.
    AmplitudeDoubtful,
    /// A height map is tilted, or has outlying pixels.
    MapDoubtful,
    /// No oil flows.
    Dry,
    /// The film is thinner than a layer of oil molecules.
    FilmBelowMolecule,
    /// The mesh costs a good part of the film.
    MeshFilm,
    /// The edges of the domain starve the film.
    ShortDomain,
    /// The time step is long beside a node or a wave that passes.
    LongStep,
    /// A wave has few nodes.
    CoarseWave,
    /// The film wave that travels at U has few nodes.
    CoarseConvectedWave,
    /// Crests slide past a material point in few time steps.
    CoarseCounting,
    /// Crests can touch at the edge of the domain.
    CrestsAtEdge,
    /// The stress volume cuts the life integral short.
    ShallowStress,
    /// A body that is not steel warms as steel does.
    ThermalUnknown,
    /// An event comes after the end of the run.
    LateEvent,
    /// A part of a height map has not passed yet.
    MapNotSeen,
    /// A made surface is one sample of many: its seed and its cut-off move the life.
    OneSample,
    /// A body stands (|S| = 2): lives are in the other's cycles, or the other's alone.
    StandingBody,
    /// The formula counts crests that the contact does not feel.
    CrestsNotFelt,
    /// The oil is sheared beyond its Eyring stress: which law it flows by moves the life.
    OilLaw,
    /// The smooth contact lives for ever: no life is relative to it.
    NoReference,
    /// The same crests meet all the way: the life hangs on an arbitrary phase.
    PhaseLocked,
    /// Models and cycle bases differ by a large factor.
    ModelRange,
    /// Life is longer than the smooth contact's.
    AboveSmooth,
    /// The average still moves, or does not cover a period of the present conditions yet.
    NotSettled,
    /// The scene computes no life.
    NoLife,
    /// A body is not steel: what it carries is not known.
    StrengthUnknown,
    /// What the model leaves out; always the last.
    ElasticOnly,
}

/// A caution: its code, and a sentence with numbers.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Caution {
    /// Kind.
    pub code: CautionCode,
    /// In words.
    pub text: String,
}

/// Error of the film by the mesh that is worth a word.
const MESH_WORTH_A_WORD: f64 = 0.05;
/// Share of all flow in one passage that is: what the interpolation of its columns misses (`yielded.rs`) is less.
const RUN_IN: f64 = 1e-3;
/// Factor between models that is.
const RANGE_WORTH_A_WORD: f64 = 2.0;
/// Life above the smooth contact's that is.
const ABOVE_WORTH_A_WORD: f64 = 1.01;

impl Frame {
    /// What to know before trusting this frame's numbers, the weightiest first.
    pub fn cautions(&self) -> Vec<Caution> {
        list(&self.metrics, &self.grounds)
    }
}

/// What to know before trusting the numbers of a step and of the passage that it ends, the weightiest first.
pub(super) fn list(m: &Metrics, grounds: &Grounds) -> Vec<Caution> {
    let mut list = Vec::new();
    let mut say = |code: CautionCode, text: Option<String>| {
        list.extend(text.map(|text| Caution { code, text }));
    };
    say(CautionCode::NotConverged, not_converged(m, grounds));
    say(CautionCode::BeyondYield, pressure_beyond(grounds));
    say(CautionCode::BeyondYield, stress_beyond(grounds));
    say(CautionCode::StillYielding, still_yielding(grounds));
    for (k, amplitude_m) in [m.amplitude_1_m, m.amplitude_2_m].into_iter().enumerate() {
        let text = |doubt: Doubt| format!("body {}: {doubt}", k + 1);
        let amplitude = Doubt::of_amplitude(amplitude_m, grounds.half_width_m);
        say(CautionCode::AmplitudeDoubtful, amplitude.map(text));
        for doubt in grounds.maps[k] {
            say(CautionCode::MapDoubtful, doubt.map(text));
        }
    }
    say(CautionCode::Dry, dry(grounds));
    say(CautionCode::FilmBelowMolecule, below_molecule(grounds));
    say(CautionCode::MeshFilm, mesh_film(grounds));
    say(CautionCode::ShortDomain, short_domain(grounds));
    for warning in resolution(m, grounds) {
        say(CautionCode::of(&warning), Some(warning.to_string()));
    }
    for text in map_not_seen(grounds) {
        say(CautionCode::MapNotSeen, Some(text));
    }
    say(CautionCode::OneSample, one_sample(m, grounds));
    say(CautionCode::StandingBody, standing(m, grounds));
    say(CautionCode::CrestsNotFelt, crests_not_felt(m, grounds));
    say(CautionCode::NoReference, no_reference(grounds));
    say(CautionCode::PhaseLocked, phase_locked(m, grounds));
    say(CautionCode::OilLaw, oil_law(m, grounds));
    say(CautionCode::ModelRange, model_range(m.life.as_ref()));
    say(CautionCode::AboveSmooth, above_smooth(m.life.as_ref()));
    say(CautionCode::NotSettled, not_settled(m, grounds));
    say(CautionCode::NoLife, no_life(grounds));
    say(CautionCode::StrengthUnknown, strength_unknown(grounds));
    say(CautionCode::ElasticOnly, Some(elastic_only(grounds)));
    list
}

/// The same of a run by that plan: with its events that never came.
pub(super) fn of_run(m: &Metrics, grounds: &Grounds, plan: &Plan) -> Vec<Caution> {
    let mut all = list(m, grounds);
    let late = plan
        .warnings
        .iter()
        .filter(|warning| matches!(warning, Warning::LateEvent { .. }));
    let late = late.map(|warning| Caution {
        code: CautionCode::of(warning),
        text: warning.to_string(),
    });
    // What every run leaves out stays the last.
    let last = all.len().saturating_sub(1);
    all.splice(last..last, late);
    all
}

fn gpa(value_pa: f64, digits: i32) -> String {
    format!("{} GPa", sig(value_pa * 1e-9, digits))
}

fn nm(value_m: f64) -> String {
    format!("{} nm", sig(value_m * 1e9, 2))
}

fn not_converged(m: &Metrics, grounds: &Grounds) -> Option<String> {
    let (n, all) = (grounds.steps_not_converged, grounds.steps);
    if n > 0 {
        return Some(format!("{n} of {all} steps did not converge"));
    }
    let residual = || {
        let left = sig(m.residual, 2);
        format!("this step did not converge: residual {left}")
    };
    (!m.converged && all > 0).then(residual)
}

/// The lesser of what both bodies carry, as far as it is known.
fn weaker(grounds: &Grounds, of: impl Fn(Strength) -> f64) -> Option<f64> {
    let known = grounds.strength.into_iter().flatten().map(of);
    known.reduce(f64::min)
}

fn pressure_beyond(grounds: &Grounds) -> Option<String> {
    let hardness = weaker(grounds, |strength| strength.hardness_pa)?;
    let p = grounds.p_max_greatest_pa;
    // Where surfaces flow at their hardness, this is it.
    (p > hardness && grounds.hardness_pa.is_none()).then(|| {
        format!(
            "greatest pressure {} is beyond what hardened steel carries (about {}, its hardness): asperities would flow",
            gpa(p, 2),
            gpa(hardness, 2)
        )
    })
}

fn stress_beyond(grounds: &Grounds) -> Option<String> {
    let (stress, measure) = grounds.sigma_eff_greatest_pa.zip(grounds.measure)?;
    // Greatest shear by Tresca; octahedral shear is √2/3 of von Mises.
    let share = match measure {
        StressMeasure::VonMises => 1.0,
        StressMeasure::MaxShear => 0.5,
        StressMeasure::Octahedral => std::f64::consts::SQRT_2 / 3.0,
    };
    let limit = share * weaker(grounds, |strength| strength.yield_pa)?;
    (stress > limit).then(|| {
        let left_out = match grounds.yielded_last_share {
            Some(_) => "what flows below the surface, and the stress that it leaves behind, is not modelled",
            None => "the material would flow there",
        };
        format!(
            "greatest {} stress {} is beyond yield of hardened steel (about {}): {left_out}",
            measure.name(),
            gpa(stress, 3),
            gpa(limit, 3)
        )
    })
}

/// Bodies that come back to the contact flow less with every round; where they do not stop, that is a ratchet.
fn still_yielding(grounds: &Grounds) -> Option<String> {
    let (share, hardness_pa) = grounds.yielded_last_share.zip(grounds.hardness_pa)?;
    (share > RUN_IN).then(|| {
        format!(
            "the surfaces still flow at {}: {} % of what has flowed so far did so in the last passage, so they are not run in",
            gpa(hardness_pa, 2),
            sig(100.0 * share, 2)
        )
    })
}

fn dry(grounds: &Grounds) -> Option<String> {
    grounds
        .film_m
        .is_none()
        .then(|| "dry: the scene has no lubricant, so no film and no λ".to_owned())
}

fn below_molecule(grounds: &Grounds) -> Option<String> {
    let film_m = grounds.film_m.filter(|film_m| *film_m < MOLECULE_M)?;
    let solved = if grounds.flows {
        "oil that is shut in carries load all the same, but is no fluid any more"
    } else {
        "solved dry"
    };
    Some(format!(
        "the smooth film by formula, {}, is less than a layer of oil molecules ({}): {solved}",
        nm(film_m),
        nm(MOLECULE_M)
    ))
}

fn mesh_film(grounds: &Grounds) -> Option<String> {
    let error = grounds
        .mesh_film
        .filter(|error| *error > MESH_WORTH_A_WORD)?;
    Some(if error < 1.0 {
        format!(
            "the mesh costs about {} % of the smooth central film at these settings; more grid.nodes make it less",
            sig(100.0 * error, 2)
        )
    } else {
        "at these settings the mesh is too coarse for the film, which may vanish; more grid.nodes help"
            .to_owned()
    })
}

fn short_domain(grounds: &Grounds) -> Option<String> {
    let error = grounds
        .short_domain
        .filter(|error| *error > EDGES_WORTH_A_WORD)?;
    Some(format!(
        "the edges of the domain starve the smooth central film by about {} % at these settings; a wider grid (grid.x_min_a, grid.y_half_a) with more grid.nodes makes it less",
        sig(100.0 * error, 2)
    ))
}

/// What the plan warns of beside film and surfaces, at the knobs' present values.
fn resolution(m: &Metrics, grounds: &Grounds) -> Vec<Warning> {
    let at = KnobsAt {
        slide_roll: m.slide_roll,
        amplitudes_m: [m.amplitude_1_m, m.amplitude_2_m],
        has_oil: grounds.film_m.is_some(),
        flows: grounds.flows,
    };
    let coarse = (grounds.resolution).map_or_else(Vec::new, |found| found.warnings(&at));
    let edge = (grounds.crests_at_edge_m).map(|crests_m| Warning::CrestsAtEdge { crests_m });
    let depth =
        (grounds.shallow_stress_a).map(|depth_max_a| Warning::ShallowStress { depth_max_a });
    let thermal = (1..).zip(grounds.thermal_unknown_pa);
    let thermal = thermal
        .filter_map(|(body, pa)| pa.map(|young_pa| Warning::ThermalUnknown { body, young_pa }));
    coarse
        .into_iter()
        .chain(edge)
        .chain(depth)
        .chain(thermal)
        .collect()
}

fn map_not_seen(grounds: &Grounds) -> Vec<String> {
    let of = |(k, part): (usize, &Option<[f64; 2]>)| {
        let [seen_m, length_m] = (*part)?;
        Some(format!(
            "{} of the {} mm of body {}'s map have passed: what is counted, and its band, know nothing of the rest; a longer run \
             (time.passages) sees it",
            sig(1e3 * seen_m, 2),
            sig(1e3 * length_m, 3),
            k + 1
        ))
    };
    let maps = grounds.map_seen_m.iter().enumerate();
    maps.filter_map(of).collect()
}

fn one_sample(m: &Metrics, grounds: &Grounds) -> Option<String> {
    let made = grounds
        .cutoffs_m
        .into_iter()
        .zip([m.amplitude_1_m, m.amplitude_2_m]);
    let rough = made.filter(|(_, amplitude_m)| *amplitude_m != 0.0);
    let cutoff_m = rough
        .filter_map(|(cutoff_m, _)| cutoff_m)
        .reduce(f64::min)?;
    grounds.has_life.then(|| {
        format!(
            "the life is that of one sample of made roughness, without waves below {}: another seed has another, a shorter cut-off \
             (surface.cutoff_short_m) most often a shorter one; a sweep over body_1.surface.seed says how much is chance",
            length(cutoff_m)
        )
    })
}

impl CautionCode {
    /// Of what a plan warns of.
    pub fn of(warning: &Warning) -> Self {
        match warning {
            Warning::CoarseForTheFilm { .. } => Self::MeshFilm,
            Warning::ShortDomain { .. } => Self::ShortDomain,
            Warning::Surface { doubt, .. } => match doubt {
                Doubt::Low { .. } | Doubt::High { .. } => Self::AmplitudeDoubtful,
                Doubt::Tilt { .. } | Doubt::Outliers { .. } => Self::MapDoubtful,
            },
            Warning::CrestsAtEdge { .. } => Self::CrestsAtEdge,
            Warning::CoarseWave { .. } => Self::CoarseWave,
            Warning::CoarseConvectedWave { .. } => Self::CoarseConvectedWave,
            Warning::CoarseCounting { .. } => Self::CoarseCounting,
            Warning::LongStep { .. } => Self::LongStep,
            Warning::NoFilm { .. } => Self::FilmBelowMolecule,
            Warning::LateEvent { .. } => Self::LateEvent,
            Warning::ThermalUnknown { .. } => Self::ThermalUnknown,
            Warning::ShallowStress { .. } => Self::ShallowStress,
        }
    }
}

fn standing(m: &Metrics, grounds: &Grounds) -> Option<String> {
    if !grounds.has_life || m.entrainment_m_s == 0.0 {
        return None;
    }
    let (body, other) = match (m.n_body_1, m.n_body_2) {
        (None, Some(_)) => (1, 2),
        (Some(_), None) => (2, 1),
        _ => return None,
    };
    if grounds.by_damage {
        return Some(format!(
            "body {body} stands (S = {}): none of its loading cycles ends; lives are in those of body {other}",
            sig(m.slide_roll, 3)
        ));
    }
    Some(format!(
        "body {body} stands (S = {}): its loading cycle never ends, so it is left out, and the life is body {other}'s, which is \
         why it rises again here",
        sig(m.slide_roll, 3)
    ))
}

fn model_range(life: Option<&LifeEstimate>) -> Option<String> {
    let detail = life?.detail;
    let (low, high) = (detail.spread_low, detail.spread_high);
    let factor = high / low;
    (detail.variants > 1 && factor >= RANGE_WORTH_A_WORD).then(|| {
        format!(
            "the choice of cycle basis and model moves the life from {} to {}, a factor of {}",
            sig(low, 2),
            sig(high, 2),
            sig(factor, 2)
        )
    })
}

fn above_smooth(life: Option<&LifeEstimate>) -> Option<String> {
    let life = life?;
    (life.life_relative_low > ABOVE_WORTH_A_WORD).then(|| {
        format!(
            "above 1: the smooth contact in pure rolling, with which life is compared, has the higher stresses (peaks \u{d7} {}); \
             sliding thins the oil, and its pressure spike is lower",
            sig(life.peak_factor, 2)
        )
    })
}

fn not_settled(m: &Metrics, grounds: &Grounds) -> Option<String> {
    let settled = m.life.is_some_and(|life| life.settled);
    let never_repeats = m.repeat.is_some_and(|r| r.rhythm == Rhythm::Statistics);
    let why = if never_repeats {
        "both bodies' waves have no common period, and the average does not cover three passages of 4a yet: it still moves"
    } else {
        "the average does not cover a whole period of these conditions yet: it still moves"
    };
    let has_life = grounds.has_life && grounds.reference == ReferenceLife::Ends;
    (has_life && !settled).then(|| why.to_owned())
}

/// Body 1 counts the crests of body 2, and the other way round.
fn crests_not_felt(m: &Metrics, grounds: &Grounds) -> Option<String> {
    let bodies = [
        (1, m.n_body_1, m.n_counted_body_1),
        (2, m.n_body_2, m.n_counted_body_2),
    ];
    let unfelt = bodies.into_iter().filter_map(|(body, n, counted)| {
        let n = n.filter(|n| *n > 1.0 && grounds.felt[body - 1] < 1.0)?;
        let counted = counted.filter(|counted| felt_where_counted(n, *counted) < 1.0);
        let why = match counted {
            Some(counted) => format!("its points count {}", fixed(counted, 2)),
            None => format!("they press less than {} % of Hertz", sig(100.0 * FELT, 1)),
        };
        let (mate, n) = (3 - body, sig(n, 3));
        Some(format!(
            "{n} contacts of body {body} by formula count crests of body {mate}, but {why}"
        ))
    });
    let unfelt: Vec<String> = unfelt.collect();
    (grounds.has_life && !unfelt.is_empty()).then(|| {
        let in_part = grounds.felt.iter().any(|felt| (1e-9..1.0).contains(felt));
        let how = if in_part {
            "the contact hardly feels them, and the spread leaves them out in part"
        } else {
            "the contact does not feel them, and the spread leaves them out"
        };
        format!("{}: {how}", unfelt.join("; "))
    })
}

fn no_reference(grounds: &Grounds) -> Option<String> {
    (grounds.reference == ReferenceLife::ForEver).then(|| {
        "no life: the smooth contact, with which lives are compared, stays below the fatigue limit (life.limit_pa) and lives for \
         ever; a lower limit, or a model without one, gives a life"
            .to_owned()
    })
}

/// Crest on crest or crest on valley: which, is chance in a machine and the scene's choice here.
fn phase_locked(m: &Metrics, grounds: &Grounds) -> Option<String> {
    let both_rough = m.amplitude_1_m > 0.0 && m.amplitude_2_m > 0.0;
    if !(grounds.has_life && both_rough) {
        return None;
    }
    if m.slide_roll == 0.0 {
        return Some(
            "S = 0: the same crests meet all the way, and this life is that of the one phase at which they do (phase_deg of a \
             surface); it is another at another phase"
                .to_owned(),
        );
    }
    let met = grounds.meetings.filter(|_| m.life.is_some());
    met.filter(|waves| *waves < 1.0).map(|waves| {
        format!(
            "S is so small that crests of both bodies have shifted by {} of a wave: the life hangs on where they began \
             (phase_deg of a surface); a longer run meets all ways",
            sig(waves, 2)
        )
    })
}

/// Friction over the Hertz ellipse as a mean shear stress.
fn oil_law(m: &Metrics, grounds: &Grounds) -> Option<String> {
    let eyring_pa = grounds.eyring_stress_pa.filter(|_| grounds.flows)?;
    let stress_pa = m.friction_coefficient.abs() * grounds.p_mean_pa;
    let times = stress_pa / eyring_pa;
    (grounds.has_life && m.slide_roll != 0.0 && times > 1.0).then(|| {
        format!(
            "the oil is sheared to {} times its Eyring stress: which law it flows by (lubricant.eyring_flow, eyring_stress_pa) \
             moves film and life, and the band does not hold that",
            sig(times, 2)
        )
    })
}

fn no_life(grounds: &Grounds) -> Option<String> {
    (!grounds.has_life).then(|| "no life in this scene: it has no [life]".to_owned())
}

fn strength_unknown(grounds: &Grounds) -> Option<String> {
    let bodies = match grounds.strength {
        [Some(_), Some(_)] => return None,
        [None, Some(_)] => "body 1 is",
        [Some(_), None] => "body 2 is",
        [None, None] => "both bodies are",
    };
    Some(format!(
        "{bodies} not steel: what they carry before they flow or break is not judged"
    ))
}

fn elastic_only(grounds: &Grounds) -> String {
    let initiation = if grounds.has_life {
        ", initiation only; c and e are assumptions"
    } else {
        ""
    };
    let elastic = match grounds.yielded_last_share {
        Some(_) => "elastic below surfaces that flow at their hardness",
        None => "elastic",
    };
    let wear = if grounds.beside.wears {
        ""
    } else {
        "no wear, "
    };
    let heat = grounds.beside.warming.words();
    format!("{wear}{heat}, {elastic}{initiation}")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::physics::strength::HARDENED_STEEL;
    use crate::plan::Resolution;
    use crate::scene::Order;
    use crate::sim::{LifeDetail, LifeEstimate};

    /// A step of a rough pair of steel rollers with nothing to complain of.
    fn sound() -> (Metrics, Grounds) {
        let metrics = Metrics {
            converged: true,
            entrainment_m_s: 1.0,
            n_body_1: Some(3.0),
            n_body_2: Some(2.0),
            life: Some(LifeEstimate {
                settled: true,
                ..LifeEstimate::default()
            }),
            ..Metrics::default()
        };
        let grounds = Grounds {
            felt: [1.0; 2],
            steps: 100,
            p_max_greatest_pa: 3e9,
            sigma_eff_greatest_pa: Some(2e9),
            measure: Some(StressMeasure::VonMises),
            strength: [Some(HARDENED_STEEL); 2],
            film_m: Some(1e-7),
            half_width_m: 2e-4,
            flows: true,
            mesh_film: Some(0.02),
            has_life: true,
            ..Grounds::default()
        };
        (metrics, grounds)
    }

    /// Waves of body 1 on a mesh of second order.
    fn coarse(nodes: [f64; 2], step_nodes: f64) -> Resolution {
        Resolution {
            nodes: [Some(nodes), None],
            step_nodes,
            is_adaptive: false,
            order: Order::Second,
        }
    }

    fn codes(m: &Metrics, grounds: &Grounds) -> Vec<CautionCode> {
        list(m, grounds).into_iter().map(|one| one.code).collect()
    }

    #[test]
    fn a_sound_step_leaves_the_general_line_alone() {
        let (m, grounds) = sound();
        assert_eq!(codes(&m, &grounds), [CautionCode::ElasticOnly]);
    }

    #[test]
    fn each_ground_has_its_caution_with_its_number() {
        use CautionCode::{
            AboveSmooth, BeyondYield, Dry, FilmBelowMolecule, MeshFilm, ModelRange, NoLife,
            NoReference, NotConverged, NotSettled, OilLaw, PhaseLocked, ShortDomain, StandingBody,
            StillYielding, StrengthUnknown,
        };
        let table: [(CautionCode, &str, Spoil); 20] = [
            (NotConverged, "3 of 100", |_, g| g.steps_not_converged = 3),
            (BeyondYield, "13 GPa", |_, g| g.p_max_greatest_pa = 13e9),
            (BeyondYield, "7.50 GPa", |_, g| {
                g.sigma_eff_greatest_pa = Some(7.5e9);
            }),
            (BeyondYield, "1.30 GPa", |_, g| {
                g.measure = Some(StressMeasure::MaxShear);
                g.sigma_eff_greatest_pa = Some(1.3e9);
            }),
            (BeyondYield, "leaves behind", |_, g| {
                (g.hardness_pa, g.yielded_last_share) = (Some(6.8e9), Some(0.0));
                g.sigma_eff_greatest_pa = Some(7.5e9);
            }),
            (StillYielding, "12 %", |_, g| {
                g.hardness_pa = Some(6.8e9);
                // At the hardness, which is not beyond it.
                g.p_max_greatest_pa = 6.9e9;
                g.yielded_last_share = Some(0.12);
            }),
            (Dry, "no lubricant", |_, g| {
                (g.film_m, g.flows, g.mesh_film) = (None, false, None);
            }),
            (FilmBelowMolecule, "0.20 nm", |_, g| g.film_m = Some(2e-10)),
            (MeshFilm, "9.8 %", |_, g| g.mesh_film = Some(0.098)),
            (ShortDomain, "2.0 %", |_, g| g.short_domain = Some(0.02)),
            (StandingBody, "body 1 stands (S = 2.00)", |m, _| {
                (m.n_body_1, m.slide_roll) = (None, 2.0);
            }),
            (NoReference, "life.limit_pa", |m, g| {
                (m.life, g.reference) = (None, ReferenceLife::ForEver);
            }),
            // .04 of 1 GPa over 5 MPa
            (OilLaw, "8.0 times", |m, g| {
                (m.slide_roll, m.friction_coefficient) = (0.5, 0.04);
                (g.eyring_stress_pa, g.p_mean_pa) = (Some(5e6), 1e9);
            }),
            (PhaseLocked, "phase_deg", |m, _| {
                (m.amplitude_1_m, m.amplitude_2_m, m.slide_roll) = (2e-7, 1e-7, 0.0);
            }),
            (PhaseLocked, "0.38 of a wave", |m, g| {
                (m.amplitude_1_m, m.amplitude_2_m, m.slide_roll) = (2e-7, 1e-7, 0.02);
                g.meetings = Some(0.38);
            }),
            (ModelRange, "factor of 28", |m, _| {
                let detail = LifeDetail {
                    spread_low: 0.025,
                    spread_high: 0.70,
                    variants: 40,
                    ..LifeDetail::default()
                };
                m.life = m.life.map(|life| LifeEstimate { detail, ..life });
            }),
            (AboveSmooth, "2.6", |m, _| {
                m.life = m.life.map(|life| LifeEstimate {
                    life_relative_low: 2.5,
                    peak_factor: 2.62,
                    ..life
                });
            }),
            (NotSettled, "period", |m, _| {
                m.life = m.life.map(|life| LifeEstimate {
                    settled: false,
                    ..life
                });
            }),
            (NoLife, "no life", |m, g| {
                (m.life, g.has_life) = (None, false);
            }),
            (StrengthUnknown, "body 2", |_, g| g.strength[1] = None),
        ];
        each_is_said(&table);
    }

    #[test]
    fn what_the_plan_warns_of_is_a_caution_at_the_knobs_of_now() {
        use CautionCode::{
            CoarseConvectedWave, CoarseCounting, CoarseWave, CrestsAtEdge, LongStep, MapNotSeen,
            OneSample, ShallowStress, ThermalUnknown,
        };
        let table: [(CautionCode, &str, Spoil); 9] = [
            (OneSample, "without waves below 60.0 µm", |m, g| {
                m.amplitude_1_m = 1e-7;
                g.cutoffs_m = [Some(60e-6), Some(20e-6)];
            }),
            (LongStep, "time.step_nodes = 2", |m, g| {
                m.amplitude_1_m = 1e-7;
                g.resolution = Some(coarse([16.0; 2], 2.0));
            }),
            (CoarseWave, "body 1: 8.0 nodes", |m, g| {
                m.amplitude_1_m = 1e-7;
                g.resolution = Some(coarse([40.0, 8.0], 0.5));
            }),
            // U1/U = 0.85 at S = 0.3.
            (CoarseConvectedWave, "15.0 nodes", |m, g| {
                (m.amplitude_1_m, m.slide_roll) = (1e-7, 0.3);
                g.resolution = Some(coarse([12.75; 2], 0.1));
            }),
            // 24 nodes a wave, a node a step, twice of it slid.
            (CoarseCounting, "passes in 12.0 steps", |m, g| {
                (m.amplitude_1_m, m.slide_roll) = (1e-7, 2.0);
                g.resolution = Some(coarse([24.0; 2], 1.0));
            }),
            (CrestsAtEdge, "1.500 µm", |_, g| {
                g.crests_at_edge_m = Some(1.5e-6);
            }),
            (ShallowStress, "stress.depth_max_a = 1.2", |_, g| {
                g.shallow_stress_a = Some(1.2);
            }),
            (ThermalUnknown, "body_2.heat", |_, g| {
                g.thermal_unknown_pa[1] = Some(7e10);
            }),
            (MapNotSeen, "0.50 of the 2.00 mm of body 2's map", |_, g| {
                g.map_seen_m[1] = Some([0.5e-3, 2e-3]);
            }),
        ];
        each_is_said(&table);
    }

    /// Changes a sound step into one with a ground for a caution.
    type Spoil = fn(&mut Metrics, &mut Grounds);

    fn each_is_said(table: &[(CautionCode, &str, Spoil)]) {
        for &(code, words, spoil) in table {
            let (mut m, mut grounds) = sound();
            spoil(&mut m, &mut grounds);
            let all = list(&m, &grounds);
            let [first, last] = &all[..] else {
                panic!("{code:?}: {all:?}");
            };
            assert_eq!((first.code, last.code), (code, CautionCode::ElasticOnly));
            assert!(first.text.contains(words), "{}", first.text);
        }
    }

    #[test]
    fn what_is_odd_of_a_surface_is_said_with_its_number() {
        use CautionCode::{AmplitudeDoubtful, MapDoubtful};
        let table: [(CautionCode, &str, Spoil); 4] = [
            (
                AmplitudeDoubtful,
                "body 1: its amplitude of 2.00e-4 nm",
                |m, _| {
                    m.amplitude_1_m = 2e-13;
                },
            ),
            (
                AmplitudeDoubtful,
                "21.0 µm is more than a tenth",
                |m, _| {
                    m.amplitude_2_m = 2.1e-5;
                },
            ),
            (MapDoubtful, "body 2: its best plane, 93.0 %", |_, g| {
                g.maps[1][0] = Some(Doubt::Tilt { share: 0.93 });
            }),
            (MapDoubtful, "body 1: 1 outlying pixel left in", |_, g| {
                g.maps[0][1] = Some(Doubt::Outliers {
                    count: 1,
                    max_over_sq: 31.9,
                });
            }),
        ];
        each_is_said(&table);
    }
}
