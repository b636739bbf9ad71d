//! What Newton's iteration does node by node, for the vector units.
//!
//! ```text
//! film      H = H0 + gap + u
//! active    P − F/D > 0;  elsewhere v = −P
//! update    P ← max(P + t v, 0), |t v| ≤ 2;  P ← (1 − t) P where not active
//! ```
//! Symbols as in `newton.rs`, which calls these.
//!
//! Part of `newton.rs`.

/// Largest change of pressure (in p_h) of one iteration at one node: twice what a smooth contact has at all. A safeguard of the path,
/// which no converged step knows of; untuned.
const STEP_LIMIT: f64 = 2.0;
/// Values side by side in sums.
const LANES: usize = 8;

dispatched! {
pub(super) fn film_row(h0: f64, gap: &[f64], u: &[f64], h: &mut [f64]) {
    let n = h.len();
    let (gap, u) = (&gap[..n], &u[..n]);
    for i in 0..n {
        h[i] = h0 + gap[i] + u[i];
    }
}
}

dispatched! {
pub(super) fn split_row(
    p: &[f64],
    f: &[f64],
    d: &[f64],
    active: &mut [bool],
    fixed: &mut [f32],
) {
    let n = p.len();
    let (f, d, active, fixed) = (&f[..n], &d[..n], &mut active[..n], &mut fixed[..n]);
    for i in 0..n {
        let is_active = p[i] - f[i] / d[i] > 0.0;
        active[i] = is_active;
        fixed[i] = if is_active { 0.0 } else { -p[i].max(0.0) as f32 };
    }
}
}

dispatched! {
/// `−F` over the row's scale; zero where not active.
pub(super) fn set_rhs(f: &[f64], scale: &[f64], active: &[bool], rhs: &mut [f32]) {
    let n = rhs.len();
    let (f, scale, active) = (&f[..n], &scale[..n], &active[..n]);
    for i in 0..n {
        let value = (-f[i] / scale[i]) as f32;
        rhs[i] = if active[i] { value } else { 0.0 };
    }
}
}

dispatched! {
/// Takes the share `t` of a step from `old`; gives Σ|dP| and ΣP.
pub(super) fn move_pressure(
    old: &[f64],
    v: &[f32],
    active: &[bool],
    t: f64,
    p: &mut [f64],
) -> (f64, f64) {
    let n = p.len();
    let (old, v, active) = (&old[..n], &v[..n], &active[..n]);
    let (mut moved, mut total) = ([0.0; LANES], [0.0; LANES]);
    let mut take = |i: usize, k: usize| {
        let step = (t * f64::from(v[i])).clamp(-STEP_LIMIT, STEP_LIMIT);
        let full = (old[i] + step).max(0.0);
        // Exactly zero for a full step: single precision would leave a trace.
        p[i] = if active[i] { full } else { old[i] * (1.0 - t) };
        moved[k] += (p[i] - old[i]).abs();
        total[k] += p[i];
    };
    let blocks = n / LANES;
    for b in 0..blocks {
        for k in 0..LANES {
            take(b * LANES + k, k);
        }
    }
    for i in blocks * LANES..n {
        take(i, 0);
    }
    (moved.iter().sum(), total.iter().sum())
}
}
