//! A scene in the making, and the forms that change it.

use super::{Choice, Drawn};
use crate::tui::units::{Units, read_number, sig};
use asperity_engine::plan::Plan;
use asperity_engine::scene::{Override, Scene, SceneError, keys, presets};

/// Changes that can be taken back.
const MOST_KEPT: usize = 100;

/// What a draft is changed by.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Form {
    /// Scene, lays, waves, oil, models, nodes.
    Scene,
    /// The numbers of the operating point.
    Point,
    /// The same as drawings have them.
    Drawing,
}

impl Form {
    /// Its rows.
    pub fn rows(self) -> &'static [Choice] {
        match self {
            Self::Scene => &Choice::SCENE,
            Self::Point => &Choice::POINT,
            Self::Drawing => &Drawn::ALL,
        }
    }
}

/// What a change is taken back to.
type Kept = (Scene, Option<&'static str>, Vec<(Drawn, f64)>);

/// A scene in the making.
#[derive(Debug, Clone)]
pub struct Draft {
    /// The scene.
    pub scene: Scene,
    /// Its rows.
    pub form: Form,
    /// A number that is typed for the chosen row.
    pub typed: Option<String>,
    /// Row that is chosen.
    pub row: usize,
    /// The plan in short, or why there is none.
    pub verdict: Result<String, String>,
    /// The preset that was chosen.
    pub preset: Option<&'static str>,
    /// What was typed as on a drawing, SI but for turns a minute and °C.
    pub(super) drawn: Vec<(Drawn, f64)>,
    /// What it was before each change.
    before: Vec<Kept>,
}

impl Draft {
    /// From a scene.
    pub fn new(scene: Scene, form: Form) -> Self {
        let mut draft = Self {
            scene,
            form,
            typed: None,
            row: 0,
            verdict: Ok(String::new()),
            preset: None,
            drawn: Vec::new(),
            before: Vec::new(),
        };
        draft.judge();
        draft
    }

    /// Chooses another row.
    pub fn choose(&mut self, by: i32) {
        let rows = self.form.rows().len() as i32;
        self.row = (self.row as i32 + by).rem_euclid(rows) as usize;
        if self.verdict.is_err() {
            // A number that was refused is past.
            self.judge();
        }
    }

    /// What the chosen row is about.
    pub fn chosen(&self) -> Choice {
        self.form.rows()[self.row]
    }

    /// Turns the rows to another form's.
    pub fn turn_to(&mut self, form: Form) {
        (self.form, self.row, self.typed) = (form, 0, None);
    }

    /// Begins a number for the chosen row, if it takes one.
    pub fn begin_typing(&mut self) {
        if self.chosen().keys(&self.scene).is_empty() {
            let name = self.chosen().name();
            self.verdict = Err(format!("{name}: no number can be typed here"));
        } else {
            self.typed = Some(String::new());
        }
    }

    /// What may be typed: key, range and unit of what is shown.
    pub fn allowed(&self, units: Units) -> Option<String> {
        let path = self.chosen().keys(&self.scene).into_iter().next()?;
        let key = keys::find(&path)?;
        let unit = self.chosen().unit(&self.scene, units).name;
        let typed = if unit.is_empty() {
            String::new()
        } else {
            format!("typed in {unit}; ")
        };
        Some(format!("{typed}{path}: {}", key.allowed()))
    }

    /// Takes the number that was typed, or says what is wrong with it: key, value, range.
    pub fn set_typed(&mut self, units: Units) {
        let Some(text) = self.typed.take() else {
            return;
        };
        let choice = self.chosen();
        match read_number(&text) {
            Some(shown) => self.put(choice, shown / choice.unit(&self.scene, units).per_si),
            None => self.verdict = Err(format!("{} = {text}: this is no number", choice.name())),
        }
        if self.verdict.is_ok() {
            self.judge();
        }
    }

    /// Puts a number into the scene, by the rules of a scene's file; a scene that breaks them stays as it was.
    pub(super) fn put(&mut self, choice: Choice, value: f64) {
        if let Choice::Drawn(drawn) = choice {
            return self.put_drawn(drawn, value);
        }
        let sets = choice.keys(&self.scene);
        let sets = sets.iter().map(|key| Override::number(key, value));
        let made = sets
            .collect::<Result<Vec<_>, SceneError>>()
            .and_then(|sets| Scene::from_toml_with(&self.scene.to_toml(), "the scene", &sets));
        match made {
            Ok(scene) => {
                self.keep();
                self.scene = scene;
                self.forget_drawn(choice);
                self.judge();
            }
            Err(error) => self.verdict = Err(error.to_string()),
        }
    }

    /// Turns the chosen row.
    pub fn turn(&mut self, by: i32) {
        self.judge();
        // A row that is put by its number keeps itself.
        if self.chosen().keys(&self.scene).is_empty() {
            self.keep();
        }
        let choice = self.chosen();
        if let Err(error) = choice.turn(self, by) {
            self.before.pop();
            self.verdict = Err(error.to_string());
        } else if choice.keys(&self.scene).is_empty() {
            self.forget_drawn(choice);
            self.judge();
        }
    }

    /// A digit: begins the number of a row that takes one, and chooses a preset in the row of presets.
    pub fn take_digit(&mut self, place: usize) {
        if !self.chosen().keys(&self.scene).is_empty() {
            self.typed = Some((place + 1).to_string());
        } else if let (Choice::Preset, Some(preset)) = (self.chosen(), presets::listed().nth(place))
        {
            self.keep();
            self.take(preset.name);
            self.forget_drawn(Choice::Preset);
            self.judge();
        }
    }

    /// Takes the last change back.
    pub fn undo(&mut self) {
        if let Some(before) = self.before.pop() {
            (self.scene, self.preset, self.drawn) = before;
            self.judge();
        }
    }

    /// Keeps what is changed next.
    pub(super) fn keep(&mut self) {
        if self.before.len() == MOST_KEPT {
            self.before.remove(0);
        }
        let kept = (self.scene.clone(), self.preset, self.drawn.clone());
        self.before.push(kept);
    }

    pub(super) fn take_preset(&mut self, by: i32) {
        let all: Vec<_> = presets::listed().collect();
        let now = self
            .preset
            .and_then(|name| all.iter().position(|preset| preset.name == name));
        let place = match now {
            Some(place) => (place as i32 + by).rem_euclid(all.len() as i32) as usize,
            None if by > 0 => 0,
            None => all.len() - 1,
        };
        self.take(all[place].name);
    }

    pub(super) fn take(&mut self, name: &'static str) {
        let opening = presets::opening(name).map(str::parse).transpose();
        let scene =
            opening.and_then(|set: Option<Override>| Scene::load_with(name, set.as_slice()));
        match scene {
            Ok(scene) => (self.scene, self.preset) = (scene, Some(name)),
            Err(error) => self.verdict = Err(error.to_string()),
        }
    }

    /// Checks the scene and makes its plan.
    pub fn judge(&mut self) {
        let made = self
            .scene
            .validate()
            .map_err(|error| error.to_string())
            .and_then(|()| Plan::new(&self.scene).map_err(|error| error.to_string()));
        self.verdict = made.map(|plan| {
            format!(
                "p_h {} GPa, {} MB, {} s a passage of 4 a on one core",
                sig(plan.hertz.p_max_pa * 1e-9, 3),
                sig(plan.cost.memory_bytes as f64 * 1e-6, 2),
                sig(
                    plan.cost.time_s / self.scene.time.most_passages().max(1e-9),
                    2
                ),
            )
        });
    }
}
