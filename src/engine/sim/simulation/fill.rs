//! Frames: SI, single precision, the whole domain also where half of it was solved.

use std::sync::Arc;

use super::present::grounds;
use super::view::View;
use crate::physics::cycles::BodyId;
use crate::plan::LINE_ROWS;
use crate::scene::ContactKind;
use crate::sim::scaling::Heading;
use crate::sim::stress_stage::StressStage;
use crate::sim::worn::Worn;
use crate::sim::{DamageBlock, Frame, MaterialPoint, PassedPeak, StressPlane, StressSlice};
use crate::solve::stress::{Cut, Plane};

/// Writes the last step of `sim` into `frame`; allocates only while the sizes change.
pub(super) fn fill(sim: View, frame: &mut Frame) {
    frame.step = sim.state.step;
    frame.time_s = sim.state.time_of_passage_s();
    frame.stage = sim.state.stage();
    frame.start_up = sim.state.start_up_progress();
    frame.passages = sim.state.passages(sim.plan.decided.passage_a);
    fill_shape(sim, frame);
    fill_fields(sim, frame);
    fill_slices(sim, frame);
    frame.material_point = material_point(sim);
    fill_planes(sim, frame);
    for body in BodyId::BOTH {
        let risk = &mut frame.risk_pa[body.index()];
        risk.clear();
        if let Some(values) = sim.state.life.as_ref().and_then(|life| life.risk(body)) {
            let unit = sim.plan.scaling.p_hertz_pa as f32;
            risk.extend(values.iter().map(|value| value * unit));
        }
        fill_damage(sim, body, &mut frame.damage[body.index()]);
        fill_suffered(sim, body, &mut frame.suffered[body.index()]);
    }
    frame.age = sim.state.ages.last().copied();
    frame.cycles = sim.state.worn.as_ref().and_then(Worn::cycles_now);
    frame.metrics.clone_from(&sim.state.metrics);
    frame.grounds = grounds(sim.plan, sim.state);
}

/// Nodes, edges and scales.
fn fill_shape(sim: View, frame: &mut Frame) {
    let (grid, scaling) = (&sim.work.solver.grid, &sim.plan.scaling);
    let scale = sim.plan.size_now(&sim.state.drive);
    frame.kind = scaling.kind;
    frame.nx = grid.nx;
    (frame.ny, frame.dy_m) = match scaling.kind {
        ContactKind::Point => (grid.ny_full(), scaling.m_from_x(grid.dy)),
        ContactKind::Line => (LINE_ROWS, sim.plan.decided.dy_m),
    };
    frame.x_min_m = match scaling.heading {
        Heading::Forward => scaling.m_from_x(grid.x_min),
        Heading::Backward => -scaling.m_from_x(grid.x(grid.nx - 1)),
    };
    frame.dx_m = scaling.m_from_x(grid.dx);
    frame.y_min_m = -0.5 * (frame.ny - 1) as f64 * frame.dy_m;
    frame.a_m = scaling.a_m * scale;
    frame.b_m = scaling.a_m * scaling.b_over_a * scale;
    frame.p_hertz_pa = scaling.p_hertz_pa * scale;
}

/// Pressure, film, traction, both surfaces, and where they touch.
fn fill_fields(sim: View, frame: &mut Frame) {
    let (scaling, state) = (&sim.plan.scaling, &sim.state.contact);
    let [one, two] = &sim.work.roughness.heights;
    let along_x = scaling.heading.sign() * scaling.p_hertz_pa;
    expand(
        sim,
        &state.pressure,
        scaling.p_hertz_pa,
        &mut frame.pressure_pa,
    );
    expand(sim, &state.film, scaling.film_m, &mut frame.film_m);
    // Where the bodies touch there is no film; what they overlap by is the solver's, and told as overlap.
    frame.film_m.iter_mut().for_each(|h| *h = h.max(0.0));
    expand(sim, &sim.work.traction, along_x, &mut frame.traction_pa);
    expand(sim, one, scaling.film_m, &mut frame.roughness_1_m);
    expand(sim, two, scaling.film_m, &mut frame.roughness_2_m);
    if let Some(heat) = &sim.work.heat {
        for (from, to) in heat.rises().into_iter().zip(&mut frame.surface_rise_k) {
            expand(sim, from, 1.0, to);
        }
        expand(sim, heat.film_rise(), 1.0, &mut frame.film_rise_k);
    }
    let contact_film = sim.plan.scaling.m_from_h(sim.plan.law.contact_film) as f32;
    frame.contact.resize(frame.film_m.len(), 0);
    let fields = frame.film_m.iter().zip(&frame.pressure_pa);
    for (c, (&h, &p)) in frame.contact.iter_mut().zip(fields) {
        *c = u8::from(p > 0.0 && h <= contact_film);
    }
}

/// A field in SI over the whole domain, in the scene's direction; 0 where a scene has no such field.
fn expand(sim: View, from: &[f64], unit: f64, to: &mut Vec<f32>) {
    let (grid, scaling) = (&sim.work.solver.grid, &sim.plan.scaling);
    let rows = match scaling.kind {
        ContactKind::Point => grid.ny_full(),
        ContactKind::Line => LINE_ROWS,
    };
    to.resize(grid.nx * rows, 0.0);
    if from.is_empty() {
        to.fill(0.0);
        return;
    }
    for (j, row) in to.chunks_exact_mut(grid.nx).enumerate() {
        let stored = match scaling.kind {
            ContactKind::Point => grid.stored_row(j),
            ContactKind::Line => 0,
        };
        let start = stored * grid.nx;
        for (to, &from) in row.iter_mut().zip(&from[start..start + grid.nx]) {
            *to = (from * unit) as f32;
        }
        if scaling.heading == Heading::Backward {
            row.reverse();
        }
    }
}

/// Stress of both bodies in the plane y = 0.
fn fill_slices(sim: View, frame: &mut Frame) {
    let Some(stress) = sim
        .work
        .stress
        .as_ref()
        .filter(|_| sim.state.phase.has_stress())
    else {
        (frame.slice, frame.slice_2) = (None, None);
        return;
    };
    fill_slice(sim, stress, BodyId::One, &mut frame.slice);
    fill_slice(sim, stress, BodyId::Two, &mut frame.slice_2);
}

fn fill_slice(sim: View, stress: &StressStage, body: BodyId, to: &mut Option<StressSlice>) {
    let from = stress.slice_in(body);
    let slice = to.get_or_insert_with(StressSlice::default);
    if slice.depths_m.len() != stress.depths().len() {
        slice.depths_m = stress
            .depths()
            .iter()
            .map(|&z| sim.plan.scaling.m_from_x(z))
            .collect::<Arc<[f64]>>();
    }
    let unit = sim.plan.scaling.p_hertz_pa as f32;
    let (nx, heading) = (sim.work.solver.grid.nx, sim.plan.scaling.heading);
    let scaled = |from: &[f32], unit: f32, to: &mut Vec<f32>| {
        to.resize(from.len(), 0.0);
        for (to, &from) in to.iter_mut().zip(from) {
            *to = from * unit;
        }
        if heading == Heading::Backward {
            to.chunks_exact_mut(nx).for_each(<[f32]>::reverse);
        }
    };
    scaled(&from.effective, unit, &mut slice.effective_pa);
    // Shear along x changes its sign in the mirror.
    let shear_unit = heading.sign() as f32 * unit;
    scaled(&from.sxz, shear_unit, &mut slice.tau_xz_pa);
}

/// Distance from a crest along +x; the solver's x is a mirror image where the flow runs towards −x.
pub(super) fn place_m(sim: View, place: f64, length: f64) -> f64 {
    match sim.plan.scaling.heading {
        Heading::Forward => sim.plan.scaling.m_from_x(place),
        Heading::Backward => sim.plan.scaling.m_from_x(length - place),
    }
}

/// The planes that the scene asks for. They run along the solver's x, which is the scene's mirror image where
/// the flow runs towards −x.
fn fill_planes(sim: View, frame: &mut Frame) {
    frame.planes.clear();
    let Some(stress) = sim
        .work
        .stress
        .as_ref()
        .filter(|_| sim.state.phase.has_stress())
    else {
        return;
    };
    let sign = sim.plan.scaling.heading.sign();
    for &cut in &sim.plan.cuts {
        let mirrored = match cut {
            Cut::X(x) => Cut::X(sign * x),
            other => other,
        };
        let Some(plane) = stress.plane(mirrored) else {
            continue;
        };
        let (normal, at) = match cut {
            Cut::X(x) => ('x', x),
            Cut::Y(y) => ('y', y),
            Cut::Z(z) => ('z', z),
        };
        frame.planes.push(plane_in_si(sim, &plane, (normal, at)));
    }
}

fn plane_in_si(sim: View, plane: &Plane, (normal, at): (char, f64)) -> StressPlane {
    let unit = sim.plan.scaling.p_hertz_pa;
    let mut out = StressPlane {
        normal,
        at_m: sim.plan.scaling.m_from_x(at),
        width: plane.width,
        rows: plane.rows,
        first_m: sim.plan.scaling.m_from_x(plane.along.0),
        step_m: sim.plan.scaling.m_from_x(plane.along.1),
        ..StressPlane::default()
    };
    let backward = normal != 'x' && sim.plan.scaling.heading == Heading::Backward;
    if backward {
        out.first_m = -out.first_m - (plane.width - 1) as f64 * out.step_m;
    }
    for row in 0..plane.rows {
        for i in 0..plane.width {
            let i = if backward { plane.width - 1 - i } else { i };
            out.effective_pa
                .push((f64::from(plane.effective[row * plane.width + i]) * unit) as f32);
            let principal = plane.state(row, i).principal();
            for (list, value) in out.principal_pa.iter_mut().zip(principal) {
                list.push((value * unit) as f32);
            }
        }
    }
    out
}

/// Columns in the opposite order.
fn mirror_columns(damage: &mut [f32], depths: usize) {
    let columns = damage.len() / depths.max(1);
    for column in 0..columns / 2 {
        let (low, high) = damage.split_at_mut((columns - 1 - column) * depths);
        low[column * depths..][..depths].swap_with_slice(&mut high[..depths]);
    }
}

/// The damage map of a body.
fn fill_damage(sim: View, body: BodyId, block: &mut Option<DamageBlock>) {
    let found = sim.state.counting.as_ref().and_then(|counting| {
        let size = sim.plan.size_now(&sim.state.drive);
        let (map, unit) = counting.map(body, size)?;
        Some((
            map,
            unit,
            counting.pit(body, size)?,
            sim.work.stress.as_ref()?,
        ))
    });
    let Some((map, unit, pit, stress)) = found else {
        *block = None;
        return;
    };
    let block = block.get_or_insert_with(DamageBlock::default);
    if block.depths_m.len() != stress.depth_count() {
        let depths = stress
            .depths()
            .iter()
            .map(|&z| sim.plan.scaling.m_from_x(z));
        block.depths_m = depths.collect();
    }
    block.length_m = sim.plan.scaling.m_from_x(map.spec().length);
    block.columns = map.spec().columns;
    block.filled = map.filled();
    map.relative_into(unit, &mut block.damage);
    if sim.plan.scaling.heading == Heading::Backward {
        let depths = map.spec().depths;
        mirror_columns(&mut block.damage, depths);
    }
    block.pit_place_m = place_m(sim, pit.place, map.spec().length);
    block.pit_depth_m = block.depths_m.get(pit.depth).copied().unwrap_or(0.0);
    block.pit_damage = pit.damage;
}

/// What the material of a body has suffered in all its cycles.
fn fill_suffered(sim: View, body: BodyId, block: &mut Option<DamageBlock>) {
    let worn = sim.state.worn.as_ref();
    let Some(pits) = worn.and_then(|worn| worn.known_pits(body.index())) else {
        *block = None;
        return;
    };
    let block = block.get_or_insert_with(DamageBlock::default);
    let (length, columns) = pits.period();
    if block.depths_m.len() != pits.depths().len() {
        let depths = pits.depths().iter();
        block.depths_m = depths.map(|&z| sim.plan.scaling.m_from_x(z)).collect();
    }
    block.length_m = sim.plan.scaling.m_from_x(length);
    (block.columns, block.filled) = (columns, columns);
    pits.suffered_into(&mut block.damage);
    if sim.plan.scaling.heading == Heading::Backward {
        mirror_columns(&mut block.damage, pits.depths().len());
    }
    let (place, depth, damage) = pits.worst();
    block.pit_place_m = place_m(sim, place * length, length);
    block.pit_depth_m = sim.plan.scaling.m_from_x(depth);
    block.pit_damage = damage;
}

/// The shown point, its stress interpolated in the slice of its body.
fn material_point(sim: View) -> Option<MaterialPoint> {
    let counting = sim.state.counting.as_ref()?;
    let shown = counting.shown?;
    let stress = sim.work.stress.as_ref()?;
    let (grid, depth) = (&sim.work.solver.grid, counting.shown_depth());
    let place = ((shown.x - grid.x_min) / grid.dx).clamp(0.0, (grid.nx - 2) as f64);
    let (i, t) = (place as usize, place.fract());
    let at = depth * grid.nx + i;
    let body = counting.shown_body();
    let slice = stress.slice_in(body);
    let effective = |n: usize| f64::from(slice.effective[n]);
    Some(MaterialPoint {
        body: body.index() as u8 + 1,
        x_m: sim.plan.scaling.place_m(shown.x),
        depth_m: sim.plan.scaling.m_from_x(stress.depths()[depth]),
        pressure_pa: sim.plan.scaling.pa_from_p(shown.pressure),
        effective_pa: sim
            .plan
            .scaling
            .pa_from_p(effective(at) * (1.0 - t) + effective(at + 1) * t),
        tau_xz_pa: sim.plan.scaling.heading.sign() * sim.plan.scaling.pa_from_p(shown.tau_xz),
        cycles_counted: f64::from(shown.peaks),
        last_peak: shown.last_peak.map(|peak| PassedPeak {
            x_m: sim.plan.scaling.place_m(peak.x),
            pressure_pa: sim.plan.scaling.pa_from_p(peak.value),
        }),
        cycles_before: shown.closed_before,
    })
}
