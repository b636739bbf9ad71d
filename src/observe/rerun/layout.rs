//! The layout in the file: tabs, views, cameras, ranges.
//!
//! The library writes containers and views but no properties of views (camera, bounds, background).
//! So the layout is first sent into memory, the properties are logged after it under
//! `view/<id>/<Property>`, and the lot is sent to the recording. That path is a convention of the
//! viewer and not of its interface: `tests/screenshots` shows whether it still holds.

pub(super) mod views;

use re_log_types::{BlueprintActivationCommand, LogMsg, StoreId};
use rerun::blueprint::components::{Corner2D, LoopMode, PanelState, PlayState};
use rerun::blueprint::{
    Blueprint, BlueprintActivation, BlueprintPanel, ContainerLike, Grid, Horizontal,
    SelectionPanel, Tabs, TextLogView, TimePanel, Vertical,
};
use rerun::external::re_sdk_types::blueprint::archetypes::PlotLegend;
use rerun::{RecordingStream, RecordingStreamBuilder};

use self::views::{Property, Views};
use super::centre_line::CENTRE_LINE;
use super::damage;
use super::interferogram::INTERFEROGRAM;
use super::kymograph;
use super::maps;
use super::moment::{SIMULATED_TIME, STEP, check_clock};
use super::plot::{Margin, PlotBox};
use super::series::{YIELDED, by_itself, entity};
use super::slice;
use super::stream::{APPLICATION, Stream};
use super::text;
use super::trace::TRACE;
use crate::observe::ObserveError;
use crate::picture::Subject;
use crate::scene::ContactKind;

/// Time that a passage of 4 a takes when it is played, s.
const PASSAGE_SHOWN_S: f64 = 10.0;

/// What the first frame tells the layout.
pub(super) struct ShownViews {
    /// Whether the run goes on while it is shown.
    pub(super) live: bool,
    /// Time of a passage of 4 a, s; `None` where nothing moves.
    pub(super) passage_s: Option<f64>,
    pub(super) kind: ContactKind,
    pub(super) map: PlotBox,
    pub(super) interferogram: PlotBox,
    pub(super) centre_line: PlotBox,
    pub(super) slice: Option<PlotBox>,
    pub(super) trace: Option<PlotBox>,
    pub(super) kymograph: PlotBox,
    /// Target and position of the camera.
    pub(super) camera: Option<[[f64; 3]; 2]>,
    pub(super) rough: [bool; 2],
    /// Bodies whose damage is mapped.
    pub(super) damaged: [bool; 2],
    pub(super) life: bool,
    /// Whether a body has a hardness at which it flows.
    pub(super) yields: bool,
}

/// Sends the layout to a recording.
pub(super) fn send(stream: &Stream, shown: &ShownViews) -> Result<(), ObserveError> {
    let mut views = Views::default();
    let tabs = tabs(&mut views, shown);
    send_tabs(stream, tabs, &views.properties, (shown.live, shown.passage_s))
}

/// Sends tabs: whether the run goes on while they are shown, and how long a passage takes in it.
pub(super) fn send_tabs(
    stream: &Stream,
    tabs: Vec<ContainerLike>,
    properties: &[Property],
    (live, passage_s): (bool, Option<f64>),
) -> Result<(), ObserveError> {
    let time = TimePanel::new()
        .with_state(PanelState::Collapsed)
        .with_play_state(PlayState::Following)
        .with_loop_mode(loop_mode(live))
        .with_fps(15.0);
    // Milliseconds, so slowly that a passage can be followed; where nothing moves there are only steps.
    let time = match passage_s {
        Some(passage_s) => time
            .with_timeline(SIMULATED_TIME)
            .with_playback_speed(passage_s / PASSAGE_SHOWN_S),
        None => time.with_timeline(STEP),
    };
    let blueprint = Blueprint::new(Tabs::new(tabs))
        .with_auto_layout(false)
        .with_auto_views(false)
        .with_blueprint_panel(BlueprintPanel::from_state(PanelState::Hidden))
        .with_selection_panel(SelectionPanel::from_state(PanelState::Hidden))
        .with_time_panel(time);
    send_with(stream.recording(), &blueprint, properties).map_err(|error| {
        ObserveError::new(
            stream.output(),
            format!("its layout could not be made: {error}"),
        )
    })
}

/// What grows is followed and never jumps back; what is whole is played again and again.
fn loop_mode(live: bool) -> LoopMode {
    if live { LoopMode::Off } else { LoopMode::All }
}

fn tabs(views: &mut Views, shown: &ShownViews) -> Vec<ContainerLike> {
    let mut tabs = vec![contact_tab(views, shown), maps_tab(views, shown)];
    if shown.trace.is_some() {
        tabs.push(point_tab(views, shown));
    }
    if shown.life {
        tabs.push(life_tab(views, shown));
    }
    tabs.push(convergence_tab(views, shown));
    tabs.push(scene_tab(views));
    tabs
}

fn contact_tab(views: &mut Views, shown: &ShownViews) -> ContainerLike {
    let mut upper = Vec::new();
    let mut shares = Vec::new();
    if let Some(camera) = shown.camera {
        upper.push(views.space("Contact cut open at y = 0", camera));
        shares.push(1.25);
    }
    upper.push(views.map(Subject::Pressure.title(), maps::PRESSURE, &[], &shown.map));
    upper.push(views.map(
        Subject::Film.title(),
        maps::FILM,
        &[maps::CONTACT],
        &shown.map,
    ));
    shares.extend([1.0, 1.0]);
    let mut lower = vec![views.document("Now", text::NOW)];
    let mut lower_shares = vec![0.75];
    if let Some(plot) = &shown.slice {
        let contents = [slice::EFFECTIVE, slice::PEAK, slice::POINT, slice::HERTZ];
        lower.push(views.plot(
            "Effective stress, a row per depth",
            &contents,
            plot,
            Margin::Legend,
        ));
        lower_shares.push(1.0);
    }
    lower.push(views.plot(
        "Centre line: pressure and film",
        &[CENTRE_LINE],
        &shown.centre_line,
        Margin::Ticks,
    ));
    lower_shares.push(1.0);
    let last = if shown.life {
        life_series(views)
    } else {
        views.series("Pressure", &["series/pressure_GPa"])
    };
    lower.push(last);
    lower_shares.push(0.7);
    Vertical::new([
        Horizontal::new(upper).with_column_shares(shares).into(),
        Horizontal::new(lower)
            .with_column_shares(lower_shares)
            .into(),
    ])
    .with_row_shares(vec![1.1, 1.0])
    .with_name("Contact")
    .into()
}

fn life_series(views: &mut Views) -> ContainerLike {
    let view = views.series("Life, log10 (grey: band)", &["life/log10_relative"]);
    // The title says it, and the curves need the room.
    views.set(&view, "PlotLegend", PlotLegend::new().with_visible(false));
    view
}

fn maps_tab(views: &mut Views, shown: &ShownViews) -> ContainerLike {
    let map = &shown.map;
    let mut all = vec![
        views.map(
            Subject::Interferogram.title(),
            INTERFEROGRAM,
            &[],
            &shown.interferogram,
        ),
        views.map(Subject::Traction.title(), maps::TRACTION, &[], map),
    ];
    for (rough, subject, entity) in [
        (shown.rough[0], Subject::Roughness1, maps::ROUGHNESS_1),
        (shown.rough[1], Subject::Roughness2, maps::ROUGHNESS_2),
    ] {
        if rough {
            all.push(views.map(subject.title(), entity, &[], map));
        }
    }
    if let Some(plot) = &shown.slice {
        all.push(views.plot(
            "Shear τxz, a row per depth",
            &[slice::TAU_XZ, slice::HERTZ],
            plot,
            Margin::Legend,
        ));
    }
    all.push(views.plot(
        "Pressure along y = 0 against time",
        &[kymograph::PRESSURE],
        &shown.kymograph,
        Margin::Legend,
    ));
    all.push(views.plot(
        "Film along y = 0 against time",
        &[kymograph::FILM],
        &shown.kymograph,
        Margin::Legend,
    ));
    if all.len() % 4 == 3 {
        all.push(views.document("Now", text::NOW));
    }
    Grid::new(all).with_grid_columns(4).with_name("Maps").into()
}

fn point_tab(views: &mut Views, shown: &ShownViews) -> ContainerLike {
    let mut upper = Vec::new();
    if let Some(plot) = &shown.trace {
        upper.push(views.plot(
            "What the followed point has felt",
            &[TRACE],
            plot,
            Margin::Plain,
        ));
    }
    if let Some(plot) = &shown.slice {
        let contents = [slice::EFFECTIVE, slice::POINT];
        upper.push(views.plot("Where the point is", &contents, plot, Margin::Legend));
    }
    let cycles = views.series("Peaks in this crossing", &["material_point/cycles"]);
    // The count climbs from the lower left to the formula's line.
    let lower_right = PlotLegend::new().with_corner(Corner2D::RightBottom);
    views.set(&cycles, "PlotLegend", lower_right);
    let lower = vec![
        views.series(
            "Stress at the point against time, GPa",
            &["material_point/stress_GPa"],
        ),
        cycles,
        views.series("Where the point is, mm", &["material_point/position_mm"]),
    ];
    let shares = if upper.len() > 1 {
        vec![1.6, 1.0]
    } else {
        vec![1.0]
    };
    Vertical::new([
        Horizontal::new(upper).with_column_shares(shares).into(),
        Horizontal::new(lower).into(),
    ])
    .with_row_shares(vec![1.3, 1.0])
    .with_name("Material point")
    .into()
}

fn life_tab(views: &mut Views, shown: &ShownViews) -> ContainerLike {
    let left = Vertical::new([
        life_series(views),
        views.series("Factors of life, log10", &["life/log10_factors"]),
    ]);
    let middle = Vertical::new([
        views.series(
            "Contacts per loading cycle, n",
            &["life/contacts_per_cycle"],
        ),
        views.series("Greatest effective stress, GPa", &["series/stress_GPa"]),
    ]);
    let maps: Vec<ContainerLike> = (0..2)
        .filter(|&body| shown.damaged[body])
        .map(|body| {
            views.plot(
                &format!("Damage of body {}, smooth worst = 0", body + 1),
                &[damage::DAMAGE[body]],
                &damage::plot_box(),
                Margin::Legend,
            )
        })
        .collect();
    let right = Vertical::new([
        views.document("Now", text::NOW),
        views.series("S, and U in m/s", &["series/motion"]),
    ]);
    let mut columns = vec![left.into(), middle.into()];
    let mut shares = vec![1.0, 0.9];
    if !maps.is_empty() {
        columns.push(Vertical::new(maps).into());
        shares.push(1.2);
    }
    columns.push(right.into());
    shares.push(0.8);
    Horizontal::new(columns)
        .with_column_shares(shares)
        .with_name("Life")
        .into()
}

fn convergence_tab(views: &mut Views, shown: &ShownViews) -> ContainerLike {
    let kind = shown.kind;
    let mut all = vec![
        views.series("Errors, log10", &["convergence/log10_errors"]),
        views.series("Iterations", &["convergence/iterations"]),
        views.series("Pressure, GPa", &["series/pressure_GPa"]),
        views.series("Film, µm", &["series/film_um"]),
        views.series("Contact, %", &["series/contact_percent"]),
        views.series("Friction coefficient", &["series/friction"]),
        match kind {
            ContactKind::Point => views.series("Load, N", &["series/load_N"]),
            ContactKind::Line => views.series("Load, N/m", &["series/load_N_per_m"]),
        },
        views.series("Hertz half-width, µm", &["series/half_width_um"]),
        views.series("λ ratio", &["series/lambda_ratio"]),
        views.series("Regime: 0 dry to 3 full film", &["series/regime"]),
        views.series("Cautions (1: holds)", &["series/cautions"]),
        TextLogView::new("Log").with_origin("/log").into(),
    ];
    if shown.yields {
        let title = match kind {
            ContactKind::Point => "Yielded for good, µm³",
            ContactKind::Line => "Yielded for good, µm³ per metre",
        };
        all.push(views.series(title, &[YIELDED]));
    }
    for quantity in by_itself() {
        all.push(views.series(&quantity.label(kind), &[&entity(quantity, kind)]));
    }
    Grid::new(all)
        .with_grid_columns(4)
        .with_name("Convergence")
        .into()
}

fn scene_tab(views: &mut Views) -> ContainerLike {
    Horizontal::new([
        views.document("About", text::ABOUT),
        views.document("Scene (TOML)", text::SCENE_TOML),
        Vertical::new([
            views.document("Plan", text::PLAN),
            views.document("Notes on the data", text::NOTES),
        ])
        .into(),
    ])
    .with_name("Scene")
    .into()
}

/// Sends a layout and the properties of its views.
fn send_with(
    recording: &RecordingStream,
    blueprint: &Blueprint,
    properties: &[Property],
) -> Result<(), Box<dyn std::error::Error>> {
    check_clock()?;
    let (draft, storage) = RecordingStreamBuilder::new(APPLICATION)
        .enabled(true)
        .memory()?;
    let not_yet = BlueprintActivation {
        make_active: false,
        make_default: false,
    };
    blueprint.send(&draft, not_yet)?;
    draft.flush_blocking()?;
    let messages = storage.take();
    // Its sink holds it: it would live for ever, with its threads.
    draft.disconnect();
    let mut messages: Vec<LogMsg> = messages
        .into_iter()
        .filter(|message| message.store_id().is_blueprint())
        .filter(|message| !matches!(message, LogMsg::BlueprintActivationCommand(_)))
        .collect();
    let id: StoreId = messages
        .first()
        .map(|message| message.store_id().clone())
        .ok_or("the layout is empty")?;

    let (extra, storage) = RecordingStreamBuilder::from_store_id(&id)
        .enabled(true)
        .send_properties(false)
        .memory()?;
    extra.set_time_sequence("blueprint", 0);
    for Property { path, value } in properties {
        extra.log(path.as_str(), value.as_ref())?;
    }
    extra.flush_blocking()?;
    let properties = storage.take();
    extra.disconnect();
    let properties = properties.into_iter();
    messages.extend(properties.filter(|message| matches!(message, LogMsg::ArrowMsg(..))));
    let activation = BlueprintActivationCommand {
        blueprint_id: id,
        make_active: true,
        make_default: true,
    };
    recording.send_blueprint(messages, activation);
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_live_does_not_loop() {
        assert_eq!(loop_mode(true), LoopMode::Off);
        assert_eq!(loop_mode(false), LoopMode::All);
    }
}
