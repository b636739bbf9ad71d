//! The layout in the file: tabs, views, cameras, ranges.
//!
//! The library writes containers and views but no properties of views (camera, bounds, background).
//! So the layout is first sent into memory, the properties are logged after it under
//! `view/<id>/<Property>`, and the lot is sent to the recording. That path is a convention of the
//! viewer and not of its interface: `tests/screenshots` shows whether it still holds.

pub(crate) mod tabs;
pub(crate) mod views;

use re_log_types::{BlueprintActivationCommand, LogMsg, StoreId};
use rerun::blueprint::components::{LoopMode, PanelState, PlayState};
use rerun::blueprint::{
    Blueprint, BlueprintActivation, BlueprintPanel, ContainerLike, SelectionPanel, Tabs, TimePanel,
};
use rerun::{RecordingStream, RecordingStreamBuilder};

use self::views::{Property, Views};
use super::moment::{SIMULATED_TIME, STEP, check_clock};
use super::shown::ShownViews;
use super::stream::{APPLICATION, Stream};
use asperity_engine::observe::ObserveError;

/// Pictures a second when a run is played, and the shortest and longest time that its scene's own end is away, s.
const PICTURES_PER_S: f64 = 12.5;
const SHOWN_S: [f64; 2] = [10.0, 20.0];

/// Simulated time over the time in which it is played, of a run of so long with so many pictures.
pub(crate) fn playback_speed(run_s: f64, pictures: f64) -> Option<f64> {
    let [shortest, longest] = SHOWN_S;
    let shown_s = (pictures / PICTURES_PER_S).clamp(shortest, longest);
    (run_s > 0.0).then(|| run_s / shown_s)
}

/// Sends the layout to a recording.
pub(crate) fn send(stream: &Stream, shown: &ShownViews) -> Result<(), ObserveError> {
    let mut views = Views::default();
    let tabs = tabs::all(&mut views, shown);
    send_tabs(stream, tabs, &views.properties, shown)
}

/// Sends what there is to see before the first frame: what runs, in words.
pub(crate) fn send_early(stream: &Stream) -> Result<(), ObserveError> {
    let mut views = Views::default();
    let words = tabs::before_the_first_frame(&mut views);
    send_played(stream, vec![words], &views.properties, true, None)
}

/// Sends tabs of what is shown.
pub(crate) fn send_tabs(
    stream: &Stream,
    tabs: Vec<ContainerLike>,
    properties: &[Property],
    shown: &ShownViews,
) -> Result<(), ObserveError> {
    send_played(stream, tabs, properties, shown.live, shown.playback_speed)
}

fn send_played(
    stream: &Stream,
    tabs: Vec<ContainerLike>,
    properties: &[Property],
    live: bool,
    playback_speed: Option<f64>,
) -> Result<(), ObserveError> {
    let time = TimePanel::new()
        .with_state(PanelState::Collapsed)
        .with_play_state(PlayState::Following)
        .with_loop_mode(loop_mode(live))
        .with_fps(15.0);
    // Milliseconds, so slowly that a passage can be followed; where nothing moves there are only steps.
    let time = match playback_speed {
        Some(speed) => time
            .with_timeline(SIMULATED_TIME)
            .with_playback_speed(speed),
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
