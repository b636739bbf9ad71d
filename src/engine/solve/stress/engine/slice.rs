//! Stress in the plane y = 0: the spectra are summed over ky, then transformed along x alone.
//!
//! ```text
//! S(c) = Σ_ky E c     σzz = −S(p̂) − z S(kD)          σxx = 2i kx S(q̂/k) − 2ν S(D) − kx² S(A0/k²) + kx² z S(D/k)
//!                     σxz = −S(q̂) + i kx z S(D)      σyy = −2(1+ν) S(D) − σxx − σzz
//! unsymmetric:        σxy = i S(ny q̂) − kx S(ny A0/k) + kx z S(ny D)      σyz = i z S(ny kD)
//! A0 = (1−2ν) p̂ + 2ν Q
//! ```
//! The columns c are formed once per surface and shared by all depths. Every depth is given at the full
//! resolution along x.
//!
//! Part of `stress/mod.rs`. Ours: its responses as polynomials in z, so that the sums over ky are formed once.

use super::super::layer::{Layer, LowRow, Waves};
use super::super::load::{Half, Spectrum};
use super::super::peak::refine;
use super::super::slice_out::{SliceOut, turn_depths, write_rows};
use super::super::spec::{Loading, StressSpec, Symmetry};
use super::super::window::LOW;
use super::StressEngine;
use crate::math::fused::Fused as _;
use crate::math::lane_fft::{Lanes, pack_pair};
use crate::math::lanes::{C, LANES, V};
use crate::physics::cycles::BodyId;

/// Most columns: seven even, four odd.
const COLUMNS: usize = 11;
/// First odd column.
const ODD: usize = 7;

/// Columns and sums.
pub(in crate::solve::stress) struct SliceScratch {
    /// `[(block · modes_y + ky) · COLUMNS + column]`.
    columns: Vec<C>,
    /// Summed spectra, `[(component · depth blocks + depth block) · kx + i]`, sixteen depths each.
    fields: Lanes,
    /// One depth block of one component before it is turned, `[block][depth]`.
    along_x: [Lanes; 3],
    other: Lanes,
}

impl SliceScratch {
    pub(in crate::solve::stress) fn new(spec: &StressSpec, waves: &Waves) -> Self {
        let depth_blocks = spec.depths.len().div_ceil(LANES);
        Self {
            columns: vec![C::ZERO; waves.blocks * waves.modes_y * COLUMNS],
            fields: Lanes::new(6 * depth_blocks * waves.blocks * LANES),
            along_x: [0, 1, 2].map(|_| Lanes::new(waves.n_x)),
            other: Lanes::new(waves.n_x),
        }
    }

    /// Memory, bytes.
    pub(in crate::solve::stress) fn bytes(&self) -> usize {
        let lanes = self.along_x.iter().map(|l| l.re.len()).sum::<usize>();
        8 * LANES * (self.columns.len() + self.fields.re.len() + lanes + self.other.re.len())
    }
}

/// What the columns are formed for.
#[derive(Clone, Copy)]
struct SliceCase {
    loading: Loading,
    material: usize,
    nu: f64,
    sheared: bool,
}

/// Spectra of one depth and block: xx, yy, zz, xz, xy, yz.
type Six = [C; 6];

impl StressEngine {
    /// Stress of body 1 in the plane y = 0 under the surface loaded last, traction included.
    ///
    /// # Panics
    /// When `out` was made for another specification.
    pub fn slice(&mut self, out: &mut SliceOut) {
        self.slice_of(Loading::Full(BodyId::One), out);
    }

    /// Stress of a body in the plane y = 0 under the surface loaded last.
    ///
    /// # Panics
    /// When `out` was made for another specification.
    pub fn slice_of(&mut self, loading: Loading, out: &mut SliceOut) {
        let (spec, waves, work) = (&self.spec, &self.waves, &mut self.slice);
        let case = SliceCase {
            loading,
            material: spec.material(loading.body()),
            nu: spec.poisson(loading.body()),
            sheared: match loading {
                Loading::Normal(_) => false,
                Loading::Full(_) => self.spectrum.sheared,
            },
        };
        assert_eq!(
            out.effective.len(),
            spec.nx * spec.depths.len(),
            "slice size"
        );
        form_columns(waves, &self.spectrum, case, &mut work.columns);
        let depth_blocks = spec.depths.len().div_ceil(LANES);
        for depth_block in 0..depth_blocks {
            let first = depth_block * LANES;
            let layers = &self.layers[first..self.layers.len().min(first + LANES)];
            for block in 0..waves.blocks {
                let mut sums = [[C::ZERO; LANES]; 6];
                for (l, layer) in layers.iter().enumerate().filter(|(_, d)| block < d.blocks) {
                    let six = sum_depth(layer, block, waves, &self.spectrum, case, &work.columns);
                    for (sum, component) in sums.iter_mut().zip(six) {
                        sum[l] = component;
                    }
                }
                let o = depth_block * waves.blocks * LANES + block * LANES;
                turn_depths(
                    &sums,
                    o,
                    depth_blocks * waves.blocks * LANES,
                    &mut work.fields,
                );
            }
        }
        for depth_block in 0..depth_blocks {
            self.slice_along_x(depth_block, depth_blocks, out);
        }
        out.peak = refine(&self.spec, out);
    }

    fn slice_along_x(&mut self, depth_block: usize, depth_blocks: usize, out: &mut SliceOut) {
        let (spec, waves, work) = (&self.spec, &self.waves, &mut self.slice);
        let width = waves.blocks * LANES;
        let line = |component: usize| (component * depth_blocks + depth_block) * width;
        let pairs = match spec.symmetry {
            Symmetry::MirrorY => 2,
            Symmetry::General | Symmetry::Line => 3,
        };
        for (pair, x) in work.along_x.iter_mut().enumerate().take(pairs) {
            let places = (line(2 * pair), Some(line(2 * pair + 1)));
            pack_pair(waves.n_x, width, places, &work.fields, x);
            self.plans[self.load.fft_x()].inverse(x, &mut work.other);
        }
        write_rows(spec, depth_block * LANES, &mut work.along_x, out);
    }
}

dispatched! {
/// Columns of the surface loaded, with −ky folded onto ky.
fn form_columns(waves: &Waves, spectrum: &Spectrum, case: SliceCase, columns: &mut [C]) {
    let nu = case.nu;
    let (two_nu, one_less) = (V::splat((2.0 * nu) as f32), V::splat((1.0 - 2.0 * nu) as f32));
    for block in 0..waves.blocks {
        for y in 0..waves.modes_y {
            let i = block * waves.modes_y + y;
            let (k, nx, ny) = (waves.k[i], waves.nx[i], waves.ny[i]);
            let mut by_k = V::ZERO;
            for l in 0..LANES {
                by_k.0[l] = if k.0[l] > 0.0 { 1.0 / k.0[l] } else { 0.0 };
            }
            let c = &mut columns[i * COLUMNS..(i + 1) * COLUMNS];
            let f = folded(spectrum, case, i, y, V::splat(1.0));
            let q = f.x.scale_i(nx);
            let d = f.p.minus(q);
            let a0 = q.fma(two_nu, f.p.scale(one_less));
            let six = [f.p, d.scale(k), d, a0.scale(by_k * by_k), d.scale(by_k), f.x];
            c[..6].copy_from_slice(&six);
            c[6] = f.x.scale(by_k);
            if spectrum.minus.is_some() {
                let f = folded(spectrum, case, i, y, V::splat(-1.0));
                let q = f.x.scale_i(nx);
                let d = f.p.minus(q);
                let a0 = q.fma(two_nu, f.p.scale(one_less));
                let odd = [f.x.scale(ny), a0.scale(ny * by_k), d.scale(ny), d.scale(ny * k)];
                c[ODD..].copy_from_slice(&odd);
            }
        }
    }
}
}

/// Spectra at ky and −ky added or subtracted.
struct Folded {
    p: C,
    x: C,
}

/// Spectrum at ky plus `sign` times that at −ky; ky = 0 counts once.
#[inline(always)]
fn folded(spectrum: &Spectrum, case: SliceCase, i: usize, y: usize, sign: V) -> Folded {
    let factor = V::splat(case.loading.traction_sign());
    let c = |lanes: &Lanes| C {
        re: lanes.re[i],
        im: lanes.im[i],
    };
    let at = |half: &Half| {
        let traction = if case.sheared {
            c(&half.x).scale(factor)
        } else {
            C::ZERO
        };
        (c(&half.p), traction)
    };
    let plus = at(&spectrum.plus);
    if y == 0 {
        return Folded {
            p: plus.0,
            x: plus.1,
        };
    }
    let (p, x) = at(spectrum.minus.as_ref().unwrap_or(&spectrum.plus));
    Folded {
        p: p.fma(sign, plus.0),
        x: x.fma(sign, plus.1),
    }
}

dispatched! {
/// Sums one depth and block over ky.
fn sum_depth(
    layer: &Layer,
    block: usize,
    waves: &Waves,
    spectrum: &Spectrum,
    case: SliceCase,
    columns: &[C],
) -> Six {
    let first = if block == 0 { LOW } else { 0 };
    let e = &layer.e[block * layer.rows..(block + 1) * layer.rows];
    let columns = &columns[block * waves.modes_y * COLUMNS..];
    let (kx, z) = (waves.kx[block], V::splat(layer.z as f32));
    let s = even_sums(&e[first..], &columns[first * COLUMNS..], case.sheared);
    let [p, kd, d, a0, d_by_k, x, x_by_k] = s;
    let kx2 = kx * kx;
    let zz = negative(kd.fma(z, p));
    let xz = d.scale_i(kx * z).minus(x);
    let elastic = d_by_k.scale(kx2 * z).minus(a0.scale(kx2));
    let two_nu = V::splat((2.0 * case.nu) as f32);
    let xx = x_by_k.fma_i(kx + kx, d.fma(-two_nu, elastic));
    let yy = d.scale(-(two_nu + V::splat(2.0))).minus(xx).minus(zz);
    let mut six = [xx, yy, zz, xz, C::ZERO, C::ZERO];
    if spectrum.minus.is_some() {
        let [x, a0, d, kd] = odd_sums(&e[first..], &columns[first * COLUMNS..]);
        six[4] = x.scale_i(V::splat(1.0)).plus(d.scale(kx * z)).minus(a0.scale(kx));
        six[5] = kd.scale_i(z);
    }
    if block == 0 {
        add_low(layer, spectrum, case, columns, &mut six);
    }
    six
}
}

#[inline(always)]
fn negative(c: C) -> C {
    C {
        re: -c.re,
        im: -c.im,
    }
}

/// Σ E c of the seven even columns: p̂, kD, D, A0/k², D/k, q̂, q̂/k.
#[inline(always)]
fn even_sums(e: &[V], columns: &[C], sheared: bool) -> [C; 7] {
    let [p, kd, a0, d_by_k] = four_sums(e, columns, [0, 1, 3, 4]);
    if !sheared {
        return [p, kd, p, a0, d_by_k, C::ZERO, C::ZERO];
    }
    let [d, x, x_by_k, _] = four_sums(e, columns, [2, 5, 6, 6]);
    [p, kd, d, a0, d_by_k, x, x_by_k]
}

/// Σ E c of the four odd columns: ny q̂, ny A0/k, ny D, ny kD.
#[inline(always)]
fn odd_sums(e: &[V], columns: &[C]) -> [C; 4] {
    four_sums(e, columns, [ODD, ODD + 1, ODD + 2, ODD + 3])
}

/// Σ E c of four columns. Eight accumulators of their own stay in registers; an array of them does not.
#[inline(always)]
fn four_sums(e: &[V], columns: &[C], which: [usize; 4]) -> [C; 4] {
    let (mut r0, mut r1, mut r2, mut r3) = ([0.0; LANES], [0.0; LANES], [0.0; LANES], [0.0; LANES]);
    let (mut i0, mut i1, mut i2, mut i3) = ([0.0; LANES], [0.0; LANES], [0.0; LANES], [0.0; LANES]);
    let [c0, c1, c2, c3] = which;
    for (e, c) in e.iter().zip(columns.chunks_exact(COLUMNS)) {
        let (c0, c1, c2, c3) = (&c[c0], &c[c1], &c[c2], &c[c3]);
        for l in 0..LANES {
            let e = e.0[l];
            r0[l] = c0.re.0[l].fused(e, r0[l]);
            i0[l] = c0.im.0[l].fused(e, i0[l]);
            r1[l] = c1.re.0[l].fused(e, r1[l]);
            i1[l] = c1.im.0[l].fused(e, i1[l]);
            r2[l] = c2.re.0[l].fused(e, r2[l]);
            i2[l] = c2.im.0[l].fused(e, i2[l]);
            r3[l] = c3.re.0[l].fused(e, r3[l]);
            i3[l] = c3.im.0[l].fused(e, i3[l]);
        }
    }
    [(r0, i0), (r1, i1), (r2, i2), (r3, i3)].map(|(re, im)| C {
        re: V(re),
        im: V(im),
    })
}

/// The windowed modes of block 0.
#[inline(always)]
fn add_low(layer: &Layer, spectrum: &Spectrum, case: SliceCase, columns: &[C], six: &mut Six) {
    let [xx, yy, zz, xz, xy, yz] = six;
    for (y, row) in layer.low[case.material].iter().enumerate() {
        let LowRow { p: t, x: u } = row;
        let c = &columns[y * COLUMNS..(y + 1) * COLUMNS];
        let (p, x) = (c[0], c[5]);
        let (t_yy, u_yy) = (t[1] + t[2], u[1] + u[2]);
        *xx = x.fma_i(u[0] + u_yy, p.fma(t[0] + t_yy, *xx));
        *yy = x.fma_i(u_yy, p.fma(t_yy, *yy));
        *zz = x.fma_i(u[2], p.fma(t[2], *zz));
        *xz = x.fma(u[4], p.fma_i(t[4], *xz));
        if spectrum.minus.is_some() {
            let f = folded(spectrum, case, y, y, V::splat(-1.0));
            *xy = f.x.fma_i(u[3], f.p.fma(t[3], *xy));
            *yz = f.x.fma(u[5], f.p.fma_i(t[5], *yz));
        }
    }
}
