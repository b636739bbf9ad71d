//! Conductance of the faces between neighbouring nodes, and its derivatives.
//!
//! ```text
//! τ = 2 q_a q_b/(q_a + q_b) × (g_a − g_b)/(ln g_a − ln g_b),   q = ρ̄H³,  g = 1/η̄*
//! ```
//! A face is addressed by the node on its low side "a": faces of a grid row with its eastern neighbours,
//! or of a grid row with the row above. One row at a time, without branches, for the vector units.
//!
//! Sources: Patankar (1980), *Numerical Heat Transfer and Fluid Flow*, §4.2, for the harmonic mean. Ours: the logarithmic mean is the
//! integral mean of g = e^{−αP} between two nodes whose flow is the same, d(g)/dX = const.

/// |Δ ln g| below which the logarithmic mean is taken from its series (next terms below 1e-13).
const NEAR: f64 = 1e-3;

/// What the faces need of a run of nodes.
#[derive(Clone, Copy)]
pub(super) struct Nodes<'a> {
    /// ρ̄H³.
    pub(super) q: &'a [f64],
    /// 1/η̄*.
    pub(super) g: &'a [f64],
    /// Its logarithm.
    pub(super) ln_g: &'a [f64],
}

/// Further values of a run of nodes for the derivatives.
#[derive(Clone, Copy)]
pub(super) struct Slopes<'a> {
    /// ∂q/∂P.
    pub(super) q_p: &'a [f64],
    /// ∂q/∂H.
    pub(super) q_h: &'a [f64],
    /// ∂ ln g/∂P.
    pub(super) ln_g_p: &'a [f64],
    /// ∂ ln g/∂H.
    pub(super) ln_g_h: &'a [f64],
}

/// Conductances of a run of faces and their derivatives.
pub(super) struct Faces {
    /// τ.
    pub(super) tau: Vec<f64>,
    /// ∂τ/∂P and ∂τ/∂H of node a.
    pub(super) p_a: Vec<f64>,
    pub(super) h_a: Vec<f64>,
    /// Same of node b.
    pub(super) p_b: Vec<f64>,
    pub(super) h_b: Vec<f64>,
}

impl Faces {
    /// Room for `n` faces.
    pub(super) fn new(n: usize) -> Self {
        let zero = vec![0.0; n];
        Self {
            tau: zero.clone(),
            p_a: zero.clone(),
            h_a: zero.clone(),
            p_b: zero.clone(),
            h_b: zero,
        }
    }

    /// Fills the faces between the runs `a` and `b`.
    pub(super) fn fill(&mut self, a: Nodes, slopes_a: Slopes, b: Nodes, slopes_b: Slopes) {
        means(
            a.q,
            a.g,
            a.ln_g,
            b.q,
            b.g,
            b.ln_g,
            &mut self.tau,
            &mut self.p_a,
            &mut self.p_b,
            &mut self.h_a,
            &mut self.h_b,
        );
        // Now p_a, p_b hold ∂τ/∂q and h_a, h_b hold ∂τ/∂ ln g.
        chain(
            slopes_a.q_p,
            slopes_a.q_h,
            slopes_a.ln_g_p,
            slopes_a.ln_g_h,
            &mut self.p_a,
            &mut self.h_a,
        );
        chain(
            slopes_b.q_p,
            slopes_b.q_h,
            slopes_b.ln_g_p,
            slopes_b.ln_g_h,
            &mut self.p_b,
            &mut self.h_b,
        );
    }
}

/// Harmonic mean of q.
#[inline(always)]
fn harmonic(q_a: f64, q_b: f64) -> f64 {
    let sum = q_a + q_b;
    let safe = if sum > 0.0 { sum } else { 1.0 };
    2.0 * q_a * q_b / safe
}

/// Logarithmic mean of g; `d` is the difference of their logarithms.
#[inline(always)]
pub(super) fn log_mean(g_a: f64, g_b: f64, d: f64) -> f64 {
    let near = d.abs() < NEAR;
    let safe = if near { 1.0 } else { d };
    let series = 0.5 * (g_a + g_b) * (1.0 - d * d / 12.0);
    if near { series } else { (g_a - g_b) / safe }
}

dispatched! {
/// `out = τ scale` between two runs of nodes.
pub(super) fn conductances(
    q_a: &[f64],
    g_a: &[f64],
    ln_a: &[f64],
    q_b: &[f64],
    g_b: &[f64],
    ln_b: &[f64],
    scale: f64,
    out: &mut [f64],
) {
    let n = out.len();
    let (q_a, g_a, ln_a) = (&q_a[..n], &g_a[..n], &ln_a[..n]);
    let (q_b, g_b, ln_b) = (&q_b[..n], &g_b[..n], &ln_b[..n]);
    for i in 0..n {
        out[i] = harmonic(q_a[i], q_b[i]) * log_mean(g_a[i], g_b[i], ln_a[i] - ln_b[i]) * scale;
    }
}
}

dispatched! {
/// τ, its derivatives by both q and by both ln g.
fn means(
    q_a: &[f64],
    g_a: &[f64],
    ln_a: &[f64],
    q_b: &[f64],
    g_b: &[f64],
    ln_b: &[f64],
    tau: &mut [f64],
    by_q_a: &mut [f64],
    by_q_b: &mut [f64],
    by_ln_a: &mut [f64],
    by_ln_b: &mut [f64],
) {
    let n = q_a.len();
    let (g_a, ln_a) = (&g_a[..n], &ln_a[..n]);
    let (q_b, g_b, ln_b) = (&q_b[..n], &g_b[..n], &ln_b[..n]);
    let (tau, by_q_a, by_q_b) = (&mut tau[..n], &mut by_q_a[..n], &mut by_q_b[..n]);
    let (by_ln_a, by_ln_b) = (&mut by_ln_a[..n], &mut by_ln_b[..n]);
    for i in 0..n {
        let sum = q_a[i] + q_b[i];
        let inverse = if sum > 0.0 { 1.0 / sum } else { 0.0 };
        let (share_a, share_b) = (q_a[i] * inverse, q_b[i] * inverse);
        let q = 2.0 * q_a[i] * share_b;
        let d = ln_a[i] - ln_b[i];
        let mean = log_mean(g_a[i], g_b[i], d);
        let near = d.abs() < NEAR;
        let over = 1.0 / if near { 1.0 } else { d };
        tau[i] = q * mean;
        by_q_a[i] = 2.0 * share_b * share_b * mean;
        by_q_b[i] = 2.0 * share_a * share_a * mean;
        by_ln_a[i] = q * if near { mean * (0.5 + d / 12.0) } else { (g_a[i] - mean) * over };
        by_ln_b[i] = q * if near { mean * (0.5 - d / 12.0) } else { (mean - g_b[i]) * over };
    }
}
}

dispatched! {
/// Chain rule: from derivatives by q (in `p`) and ln g (in `h`) to those by P and H.
fn chain(
    q_p: &[f64],
    q_h: &[f64],
    ln_p: &[f64],
    ln_h: &[f64],
    p: &mut [f64],
    h: &mut [f64],
) {
    let n = q_p.len();
    let (q_h, ln_p, ln_h) = (&q_h[..n], &ln_p[..n], &ln_h[..n]);
    let (p, h) = (&mut p[..n], &mut h[..n]);
    for i in 0..n {
        let (by_q, by_ln) = (p[i], h[i]);
        p[i] = by_q * q_p[i] + by_ln * ln_p[i];
        h[i] = by_q * q_h[i] + by_ln * ln_h[i];
    }
}
}
