//! From the surface to its spectrum: pressure and traction share one complex transform.
//!
//! ```text
//! Z = FFT(p + i q_x);   P(k) = (Z(k) + conj Z(−k))/2,   X(k) = (Z(k) − conj Z(−k))/2i
//! ```
//! First along y (x in the lanes: rows are read as they lie), then along x. A mirror surface is
//! extended evenly, and its spectrum is even in ky, so one half serves.
//!
//! Source: Press et al. (2007), *Numerical Recipes*, §12.3: two real transforms in one.

use super::layer::Waves;
use super::spec::{StressSpec, Symmetry};
use crate::math::lane_fft::plan_of;
use crate::math::lane_fft::{LaneFft, Lanes};
use crate::math::lanes::{LANES, V, transpose};

/// Spectra of pressure and traction at ky ≥ 0 or at −ky, `[block · modes_y + ky]`, sixteen kx each.
pub(super) struct Half {
    pub(super) p: Lanes,
    pub(super) x: Lanes,
}

/// Spectrum of the surface loaded last.
pub(super) struct Spectrum {
    pub(super) plus: Half,
    /// At −ky; `None` for a mirror surface, where it equals `plus`.
    pub(super) minus: Option<Half>,
    /// Whether a traction was loaded.
    pub(super) sheared: bool,
}

impl Spectrum {
    pub(super) fn new(symmetry: Symmetry, waves: &Waves) -> Self {
        let half = || Half {
            p: Lanes::new(waves.blocks * waves.modes_y),
            x: Lanes::new(waves.blocks * waves.modes_y),
        };
        Self {
            plus: half(),
            minus: (symmetry == Symmetry::General).then(half),
            sheared: false,
        }
    }

    pub(super) fn lanes(&self) -> impl Iterator<Item = &Lanes> {
        std::iter::once(&self.plus)
            .chain(&self.minus)
            .flat_map(|half| [&half.p, &half.x])
    }
}

/// Buffers of the two passes.
pub(super) struct LoadScratch {
    fft_x: usize,
    fft_y: usize,
    along_y: [Lanes; 2],
    /// At ky ≥ 0 and at −ky.
    along_x: [[Lanes; 2]; 2],
    /// After the y pass, `[ky block · n_x + x]`, sixteen ky each; at ky ≥ 0 and at −ky.
    middle: [Lanes; 2],
}

impl LoadScratch {
    pub(super) fn new(waves: &Waves, plans: &mut Vec<LaneFft>) -> Self {
        let middle = waves.modes_y.div_ceil(LANES) * waves.n_x;
        let twice = |n: usize| [Lanes::new(n), Lanes::new(n)];
        Self {
            fft_x: plan_of(plans, waves.n_x),
            fft_y: plan_of(plans, waves.n_y),
            along_y: twice(waves.n_y),
            along_x: [twice(waves.n_x), twice(waves.n_x)],
            middle: twice(middle),
        }
    }

    /// Memory, bytes.
    pub(super) fn bytes(&self) -> usize {
        let buffers = self.along_y.iter().chain(self.along_x.iter().flatten());
        let all = buffers.chain(&self.middle).map(|lanes| lanes.re.len());
        8 * LANES * all.sum::<usize>()
    }

    /// Plan of the whole period along x.
    pub(super) fn fft_x(&self) -> usize {
        self.fft_x
    }
}

/// A surface on its way to the spectrum.
pub(super) struct SurfaceLoad<'a> {
    pub(super) spec: &'a StressSpec,
    pub(super) waves: &'a Waves,
    pub(super) plans: &'a [LaneFft],
    pub(super) work: &'a mut LoadScratch,
    pub(super) spectrum: &'a mut Spectrum,
}

impl SurfaceLoad<'_> {
    /// Takes the surface: pressure `p` and, where there is friction, traction `qx` on body 1 along +x, both
    /// in p_h, `[j·nx + i]`, `ny` rows (see [`Symmetry`]). The outermost nodes are the domain's edge, where
    /// the pressure is zero.
    ///
    /// # Panics
    /// When a field has not `nx · ny` values.
    pub(super) fn load(mut self, p: &[f32], qx: Option<&[f32]>) {
        self.transform(p, qx);
        self.spectrum.sheared = qx.is_some();
        let scale = 0.5 / (self.waves.n_x as f64 * self.waves.n_y as f64);
        self.along_x(|z, mate, waves, ky_block, half| {
            separate(z, mate, waves, ky_block, scale as f32, half);
        });
    }

    /// The pass along y of `re + i im`.
    fn transform(&mut self, re: &[f32], im: Option<&[f32]>) {
        let nodes = self.spec.nx * self.spec.ny;
        for field in std::iter::once(re).chain(im) {
            assert_eq!(field.len(), nodes, "a field has nx · ny values");
        }
        let (spec, waves, work) = (self.spec, self.waves, &mut *self.work);
        let signs = match spec.symmetry {
            Symmetry::General | Symmetry::Line => 2,
            Symmetry::MirrorY => 1,
        };
        for block in 0..spec.nx.div_ceil(LANES) {
            let [input, other] = &mut work.along_y;
            read_rows(spec, block, re, &mut input.re);
            match im {
                Some(im) => read_rows(spec, block, im, &mut input.im),
                None => input.im.fill(V::ZERO),
            }
            self.plans[work.fft_y].forward(input, other);
            for (sign, middle) in work.middle.iter_mut().enumerate().take(signs) {
                turn_to_ky(input, waves, block, sign, middle);
            }
        }
    }

    /// The pass along x; `store` takes the modes at one ky and, as its mate, at −ky.
    fn along_x(&mut self, mut store: impl FnMut(&Lanes, &Lanes, &Waves, usize, &mut Half)) {
        let (waves, work) = (self.waves, &mut *self.work);
        let plan = &self.plans[work.fft_x];
        let filled = self.spec.nx.div_ceil(LANES) * LANES;
        for ky_block in 0..waves.modes_y.div_ceil(LANES) {
            let line = |middle: &Lanes, input: &mut Lanes| {
                let o = ky_block * waves.n_x;
                for (from, to) in [(&middle.re, &mut input.re), (&middle.im, &mut input.im)] {
                    to[..filled].copy_from_slice(&from[o..o + filled]);
                    to[filled..].fill(V::ZERO);
                }
            };
            let [[in_plus, other_plus], [in_minus, other_minus]] = &mut work.along_x;
            line(&work.middle[0], in_plus);
            plan.forward(in_plus, other_plus);
            let plus = &mut self.spectrum.plus;
            match &mut self.spectrum.minus {
                None => store(in_plus, in_plus, waves, ky_block, plus),
                Some(minus) => {
                    line(&work.middle[1], in_minus);
                    plan.forward(in_minus, other_minus);
                    store(in_plus, in_minus, waves, ky_block, plus);
                    store(in_minus, in_plus, waves, ky_block, minus);
                }
            }
        }
    }
}

/// Sixteen columns of the surface, the axis at index 0 and y < 0 at the end of the period.
fn read_rows(spec: &StressSpec, block: usize, field: &[f32], out: &mut [V]) {
    let n = out.len();
    let columns = block * LANES..spec.nx.min((block + 1) * LANES);
    let row = |j: usize| V::from_part(&field[j * spec.nx..][columns.clone()]);
    out.fill(V::ZERO);
    match spec.symmetry {
        Symmetry::MirrorY => {
            for j in 0..spec.ny {
                let here = row(j);
                out[(n - j) % n] = here;
                out[j] = here;
            }
        }
        Symmetry::General | Symmetry::Line => {
            let axis = spec.ny / 2;
            for j in 0..spec.ny {
                out[(j + n - axis) % n] = row(j);
            }
        }
    }
}

dispatched! {
/// Exchanges x in the lanes for ky in the lanes; `sign` 1 takes −ky.
fn turn_to_ky(z: &Lanes, waves: &Waves, block: usize, sign: usize, middle: &mut Lanes) {
    let n = waves.n_y;
    for ky_block in 0..waves.modes_y.div_ceil(LANES) {
        let o = ky_block * waves.n_x + block * LANES;
        for (from, to) in [(&z.re, &mut middle.re), (&z.im, &mut middle.im)] {
            let mut rows = [V::ZERO; LANES];
            for (l, row) in rows.iter_mut().enumerate() {
                let ky = ky_block * LANES + l;
                *row = from[if sign == 0 { ky % n } else { (n - ky) % n }];
            }
            to[o..o + LANES].copy_from_slice(&transpose(&rows));
        }
    }
}
}

dispatched! {
/// Pressure and traction out of their common transform; `mate` holds the modes at −ky.
fn separate(
    z: &Lanes,
    mate: &Lanes,
    waves: &Waves,
    ky_block: usize,
    scale: f32,
    half: &mut Half,
) {
    let n = waves.n_x;
    let scale = V::splat(scale);
    for block in 0..waves.blocks {
        let [mut p_re, mut p_im] = [[V::ZERO; LANES]; 2];
        let [mut q_re, mut q_im] = [[V::ZERO; LANES]; 2];
        let first = block * LANES;
        for kx in first..waves.modes_x.min(first + LANES) {
            let (l, minus) = (kx - first, (n - kx) % n);
            let (re, im) = (z.re[kx], z.im[kx]);
            let (mate_re, mate_im) = (mate.re[minus], mate.im[minus]);
            p_re[l] = (re + mate_re) * scale;
            p_im[l] = (im - mate_im) * scale;
            q_re[l] = (im + mate_im) * scale;
            q_im[l] = (mate_re - re) * scale;
        }
        let from = block * waves.modes_y + ky_block * LANES;
        let count = (waves.modes_y - ky_block * LANES).min(LANES);
        let targets = [&mut half.p.re, &mut half.p.im, &mut half.x.re, &mut half.x.im];
        for (line, to) in [&p_re, &p_im, &q_re, &q_im].into_iter().zip(targets) {
            to[from..from + count].copy_from_slice(&transpose(line)[..count]);
        }
    }
}
}
