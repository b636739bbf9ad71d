//! The layout of runs that stand beside each other: what is alike has one size and one place in its row.

use rerun::blueprint::{ContainerLike, Horizontal, Vertical};
use rerun::external::re_sdk_types::blueprint::archetypes::PlotLegend;

use crate::entities::centre_line::CENTRE_LINE;
use crate::entities::profile::PROFILE;
use crate::entities::series::{LIFE, POINT_CYCLES};
use crate::entities::text::{COMPARISON, LECTURE, NOW, SCENE_TOML};
use crate::entities::trace::TRACE;
use crate::entities::{DIFFERENCE, kymograph, maps};
use crate::layout::send_tabs;
use crate::layout::tabs::stress;
use crate::layout::views::Views;
use crate::plot::Margin;
use crate::shown::ShownViews;
use crate::stream::Stream;
use asperity_engine::observe::ObserveError;
use asperity_engine::scene::ContactKind;

/// Names of the runs, which stand before those of their entities.
pub(crate) const RUNS: [&str; 3] = ["a", "b", "c"];
/// The runs' colours in words.
const COLOUR_WORDS: [&str; 3] = ["orange", "blue", "green"];

/// A run, and what its views show.
pub(crate) struct ShownRun {
    pub(crate) name: &'static str,
    pub(crate) views: ShownViews,
}

/// Sends the layout.
pub(crate) fn send(stream: &Stream, runs: &[ShownRun], names: &[&str]) -> Result<(), ObserveError> {
    let mut layout = Layout {
        views: Views::default(),
        runs,
        names,
    };
    let tabs = vec![
        layout.passages(),
        layout.contacts(),
        layout.traces(),
        layout.films(),
        layout.stresses(),
        layout.about(),
    ];
    match runs.first() {
        Some(first) => send_tabs(stream, tabs, &layout.views.properties, &first.views),
        None => Ok(()),
    }
}

struct Layout<'a> {
    views: Views,
    runs: &'a [ShownRun],
    names: &'a [&'a str],
}

impl Layout<'_> {
    /// A view of every run that has it: `make` gets the run and the title's end.
    fn each(
        &mut self,
        make: impl Fn(&mut Views, &ShownViews, &str) -> Option<ContainerLike>,
    ) -> Vec<ContainerLike> {
        let mut row = Vec::new();
        for (run, name) in self.runs.iter().zip(self.names) {
            self.views.under = format!("{}/", run.name);
            row.extend(make(&mut self.views, &run.views, name));
        }
        self.views.under.clear();
        row
    }

    /// The contacts, the pressures with their difference, and both lives.
    fn contacts(&mut self) -> ContainerLike {
        let spaces = self.each(|views, shown, name| {
            let colour = RUNS.iter().zip(COLOUR_WORDS);
            let colour = colour.filter(|(run, _)| views.under.starts_with(**run));
            let colour = colour.map(|(_, word)| word).next().unwrap_or_default();
            let title = format!("{name} ({colour} in curves of both)");
            Some(views.space(&title, shown.camera?))
        });
        let mut lower = self.each(|views, shown, name| Some(pressure(views, shown, name)));
        lower.extend(self.differences(ContactKind::Point));
        lower.push(self.life());
        rows([spaces, lower], "Contacts")
    }

    fn differences(&mut self, of: ContactKind) -> Vec<ContainerLike> {
        let first = self.names.first().copied().unwrap_or_default();
        let title = |name: &str| format!("Pressure of {name} less {first}");
        self.each(|views, shown, name| {
            let is_other = views.under != format!("{}/", RUNS[0]);
            let map = |views: &mut Views| views.map(&title(name), DIFFERENCE, &[], &shown.map);
            (is_other && shown.kind == of).then(|| map(views))
        })
    }

    fn life(&mut self) -> ContainerLike {
        self.together("Relative life, log10 (thin: its band)", LIFE)
    }

    /// Curves of all runs in one view.
    fn together(&mut self, title: &str, entity: &str) -> ContainerLike {
        let entities: Vec<String> = self
            .runs
            .iter()
            .map(|run| format!("{}/{entity}", run.name))
            .collect();
        let entities: Vec<&str> = entities.iter().map(String::as_str).collect();
        let view = self.views.series(title, &entities);
        // The titles of the first views tell the colours, and the curves need the room.
        let hidden = PlotLegend::new().with_visible(false);
        self.views.set(&view, "PlotLegend", hidden);
        view
    }

    /// Surfaces, oil and traces of the runs, and below each what it costs.
    fn passages(&mut self) -> ContainerLike {
        let upper = self.each(|views, shown, name| {
            let title = format!("Both surfaces and the gap between them: {name}");
            Some(views.framed(&title, &[PROFILE, TRACE], shown.profile?))
        });
        let lower = self.each(|views, _, name| Some(views.document(name, LECTURE)));
        let has_profile = !upper.is_empty();
        let rows = [upper, lower].into_iter().filter(|row| !row.is_empty());
        let all = Vertical::new(rows.map(|row| Horizontal::new(row).into()));
        let shares = if has_profile {
            vec![2.6, 1.0]
        } else {
            vec![1.0]
        };
        all.with_row_shares(shares).with_name("Side by side").into()
    }

    fn traces(&mut self) -> ContainerLike {
        let upper = self.each(|views, shown, name| {
            let plot = shown.trace.as_ref()?;
            let title = format!("What the followed point has felt: {name}");
            Some(views.plot(&title, &[TRACE], plot, Margin::Plain))
        });
        let mut lower = vec![
            self.life(),
            self.together("Peaks in this crossing", POINT_CYCLES),
        ];
        lower.extend(self.each(|views, _, name| Some(views.document(name, NOW))));
        rows([upper, lower], "Traces and life")
    }

    fn films(&mut self) -> ContainerLike {
        let upper = self.each(|views, shown, name| match shown.kind {
            ContactKind::Point => Some(views.map(
                &format!("Film: {name}"),
                maps::FILM,
                &[maps::CONTACT],
                &shown.map,
            )),
            ContactKind::Line => Some(over_time(views, shown, name)),
        });
        let lower = self.each(|views, shown, name| match shown.kind {
            ContactKind::Point => Some(centre_line(views, shown, name)),
            ContactKind::Line => None,
        });
        let differences = self.differences(ContactKind::Line);
        rows([upper, lower, differences], "Film")
    }

    fn stresses(&mut self) -> ContainerLike {
        let upper = self.each(|views, shown, name| stress(views, shown, &format!(": {name}")));
        let lower = self.each(|views, shown, name| match shown.kind {
            ContactKind::Point => Some(over_time(views, shown, name)),
            ContactKind::Line => None,
        });
        rows([upper, lower], "Stress and time")
    }

    fn about(&mut self) -> ContainerLike {
        let mut all = vec![self.views.document("What stands beside what", COMPARISON)];
        all.extend(
            self.each(|views, _, name| Some(views.document(&format!("Scene: {name}"), SCENE_TOML))),
        );
        Horizontal::new(all).with_name("About").into()
    }
}

/// Rows that hold something, one below the other.
fn rows(rows: impl IntoIterator<Item = Vec<ContainerLike>>, name: &str) -> ContainerLike {
    let rows = rows.into_iter().filter(|row| !row.is_empty());
    Vertical::new(rows.map(|row| Horizontal::new(row).into()))
        .with_name(name)
        .into()
}

/// The pressure: of a point contact its map, of a line contact the centre line, which tells all of it.
fn pressure(views: &mut Views, shown: &ShownViews, name: &str) -> ContainerLike {
    match shown.kind {
        ContactKind::Point => views.map(
            &format!("Pressure: {name}"),
            maps::PRESSURE,
            &[],
            &shown.map,
        ),
        ContactKind::Line => centre_line(views, shown, name),
    }
}

fn centre_line(views: &mut Views, shown: &ShownViews, name: &str) -> ContainerLike {
    let title = format!("Pressure and film: {name}");
    views.plot(&title, &[CENTRE_LINE], &shown.centre_line, Margin::Ticks)
}

fn over_time(views: &mut Views, shown: &ShownViews, name: &str) -> ContainerLike {
    let title = format!("Pressure against time: {name}");
    views.plot(
        &title,
        &[kymograph::PRESSURE],
        &shown.kymograph,
        Margin::Legend,
    )
}
