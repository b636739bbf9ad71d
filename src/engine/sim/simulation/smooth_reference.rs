//! Steps of the smooth contact beside the run ([`Smooth`]), and what becomes of it.

use super::Simulation;
use crate::sim::motion::Travel;
use crate::sim::pace::Stepping;
use crate::sim::smooth::{LoadAndSpeed, Smooth};
use crate::sim::stepping::Mover;
use crate::sim::{Knob, StepError};

impl Simulation {
    /// Load and speed that the knobs go to.
    fn conditions(&self) -> LoadAndSpeed {
        let target = |knob| self.state.drive.get(knob).target;
        LoadAndSpeed {
            load: target(self.plan.scaling.load_knob()),
            speed_m_s: target(Knob::EntrainmentMS),
        }
    }

    /// Whether the reference is that of the load and speed that the knobs go to.
    pub(super) fn has_reference_of_now(&self) -> bool {
        let life = self.state.life.as_ref();
        life.is_none_or(|life| life.reference_at == self.conditions())
    }

    /// One step of the smooth contact, where the reference is another one's.
    ///
    /// # Errors
    /// [`StepError`] as of the run's own steps.
    pub(super) fn step_smooth(&mut self) -> Result<(), StepError> {
        let mut smooth = match self.state.smooth.take() {
            Some(smooth) => smooth,
            None if self.has_reference_of_now() => return Ok(()),
            None => self.begin_smooth(self.conditions()),
        };
        if smooth.left == 0 {
            if smooth.nodes == self.plan.decided.domain.nodes {
                self.work.smooth = None;
                self.take_smooth(&smooth);
                return Ok(());
            }
            self.refine_smooth(&mut smooth);
        }
        let made = self.advance_smooth(&mut smooth);
        smooth.left -= u64::from(made.is_ok());
        self.state.smooth = Some(smooth);
        made
    }

    /// A Hertz contact of that load on the coarsest grid.
    fn begin_smooth(&mut self, at: LoadAndSpeed) -> Smooth {
        let nodes = self.plan.first_nodes();
        let size = self
            .plan
            .scaling
            .size_ratio(at.load / self.plan.decided.force_n);
        let film = self.plan.film_at(at);
        let central = film.map_or(0.0, |film| self.plan.scaling.h_from_m(film.central_m));
        let mut drive = self.state.targets.smooth();
        drive.jump(self.plan.scaling.load_knob(), at.load);
        drive.jump(Knob::EntrainmentMS, at.speed_m_s);
        let mut work = self.work.take_smooth(&self.plan, nodes);
        let hertz = || work.solver.hertz_of_size(&self.plan.shape, (size, central));
        let contact = self.work.pool.install(hertz);
        self.work.smooth = Some(work);
        Smooth {
            nodes,
            contact,
            drive,
            motion: Travel::new(),
            at,
            left: self.plan.smooth_steps(nodes, self.flows_at(at)),
        }
    }

    fn flows_at(&self, at: LoadAndSpeed) -> bool {
        self.plan.film_at(at).is_some_and(|film| film.flows())
    }

    fn refine_smooth(&self, smooth: &mut Smooth) {
        let grid = |nodes| self.plan.grid(nodes);
        let next = 2 * (smooth.nodes - 1) + 1;
        smooth.contact = smooth.contact.refined(&grid(smooth.nodes), &grid(next));
        smooth.nodes = next;
        smooth.left = self.plan.smooth_steps(next, self.flows_at(smooth.at));
    }

    fn advance_smooth(&mut self, smooth: &mut Smooth) -> Result<(), StepError> {
        let mut work = self.work.take_smooth(&self.plan, smooth.nodes);
        let usual = self.plan.stepping.usual();
        let before = work.solver.transforms();
        let attempted = self.work.pool.install(|| {
            Mover {
                state: &mut smooth.contact,
                solver: &mut work.solver,
                roughness: &mut work.roughness,
                drive: &mut smooth.drive,
                motion: &mut smooth.motion,
                plan: &self.plan,
                stepping: Stepping::Fixed(usual),
                yielded: None,
            }
            .advance(usual)
        });
        let made = work.solver.transforms() - before;
        self.work.smooth = Some(work);
        self.stats.add(&attempted, made);
        attempted.fatal(self.state.time_s).map_or(Ok(()), Err)
    }

    /// Its integrals become the reference of now; the slices below the run's own contact are made again.
    fn take_smooth(&mut self, smooth: &Smooth) {
        let size = self
            .plan
            .scaling
            .size_ratio(smooth.at.load / self.plan.decided.force_n);
        let state = &mut self.state;
        if let (Some(stress), Some(life)) = (&mut self.work.stress, &mut state.life) {
            self.work.pool.install(|| {
                stress.slice(&smooth.contact.pressure, &[], 0.0);
                life.move_reference(stress, size, smooth.at);
                self.stats.stress_volumes += u64::from(life.integrates());
                if let Some(counting) = &mut state.counting {
                    counting.set_reference(stress, size);
                }
            });
        }
        self.slice_again();
    }
}
