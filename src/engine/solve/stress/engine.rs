//! The engine: what it holds, and how it is built.
//!
//! Part of `stress/mod.rs`.

mod plane;
mod slice;
mod volume;

use self::slice::SliceScratch;
use self::volume::Worker;
use super::layer::{Layer, Waves, layers};
use super::load::{LoadScratch, Spectrum, SurfaceLoad};
use super::spec::{Purpose, StressError, StressSpec};
use super::sums::VolumeSums;
use crate::math::lane_fft::{LaneFft, Lanes};
use crate::math::lanes::LANES;
pub use plane::{Cut, Plane};
pub use volume::VolumeOut;

/// The engine: tables, spectra of the surface loaded last, scratch.
pub struct StressEngine {
    pub(super) spec: StressSpec,
    pub(super) waves: Waves,
    pub(super) layers: Vec<Layer>,
    pub(super) plans: Vec<LaneFft>,
    pub(super) spectrum: Spectrum,
    pub(super) load: LoadScratch,
    pub(super) slice: SliceScratch,
    pub(super) workers: Vec<Worker>,
    pub(super) sums: VolumeSums,
}

impl StressEngine {
    /// Builds the tables and makes all memory, for the number of threads of the current pool.
    ///
    /// # Errors
    /// [`StressError`] names the entry of the specification that is out of range.
    pub fn new(spec: &StressSpec) -> Result<Self, StressError> {
        spec.check()?;
        let padded =
            |nodes: usize| LaneFft::good_length((spec.pad * (nodes - 1) as f64).ceil() as usize);
        let (n_x, n_y) = (padded(spec.nx), padded(spec.full_rows()));
        let waves = Waves::new(n_x, n_y, n_x as f64 * spec.dx, n_y as f64 * spec.dy);
        let mut plans = Vec::new();
        let layers = layers(spec, &waves, &mut plans);
        let threads = match spec.purpose {
            Purpose::Slices => 0,
            Purpose::Volumes => rayon::current_num_threads().min(spec.depths.len()),
        };
        Ok(Self {
            spectrum: Spectrum::new(spec.symmetry, &waves),
            load: LoadScratch::new(&waves, &mut plans),
            slice: SliceScratch::new(spec, &waves),
            workers: (0..threads)
                .map(|_| Worker::new(spec.symmetry, &waves, &layers))
                .collect(),
            sums: VolumeSums::new(spec, &layers),
            spec: spec.clone(),
            waves,
            layers,
            plans,
        })
    }

    /// Takes the surface: pressure `p` and, where there is friction, traction `qx` on body 1 along +x, both
    /// in p_h, `[j·nx + i]`, `ny` rows (see [`Symmetry`]). The outermost nodes are the domain's edge, where
    /// the pressure is zero.
    ///
    /// # Panics
    /// When a field has not `nx · ny` values.
    pub fn load(&mut self, p: &[f32], qx: Option<&[f32]>) {
        SurfaceLoad {
            spec: &self.spec,
            waves: &self.waves,
            plans: &self.plans,
            work: &mut self.load,
            spectrum: &mut self.spectrum,
        }
        .load(p, qx);
    }

    /// What was asked for.
    pub fn spec(&self) -> &StressSpec {
        &self.spec
    }

    /// Memory of tables and scratch, bytes.
    pub fn bytes(&self) -> usize {
        let v = LANES * 4;
        let lanes = |l: &Lanes| 2 * v * l.re.len();
        let layers: usize = self.layers.iter().map(Layer::bytes).sum();
        let workers: usize = self.workers.iter().map(Worker::bytes).sum();
        let spectra: usize = self.spectrum.lanes().map(lanes).sum();
        let waves = 3 * v * self.waves.k.len();
        layers
            + workers
            + spectra
            + waves
            + self.slice.bytes()
            + self.load.bytes()
            + self.sums.bytes()
    }
}
