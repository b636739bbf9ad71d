//! The discrete Reynolds equation row by row, for the vector units: density, balance, linearisation.
//!
//! ```text
//! q = ρ̄H³
//! F = ρ̄H − C* − s Σ_faces w τ (P_m − P_n),   D = ρ̄K00 + s Σ w τ
//! ∂F: own + w s (τ − τ_P dP), −w s τ_H dP;  neighbour −w s (τ + τ_P' dP), −w s τ_H' dP
//! ```
//! Symbols as in `reynolds.rs`, which calls these; test there: the linearisation is the derivative.
//!
//! Part of `reynolds.rs`.

use crate::physics::fluid::Density;

dispatched! {
pub(super) fn density_values(
    law: Density,
    p: &[f64],
    h: &[f64],
    q: &mut [f64],
    rho: &mut [f64],
    rho_p: &mut [f64],
) {
    let n = p.len();
    let (h, q, rho, rho_p) = (&h[..n], &mut q[..n], &mut rho[..n], &mut rho_p[..n]);
    for i in 0..n {
        let (value, slope) = law.rho(p[i]);
        let open = h[i].max(0.0);
        rho[i] = value;
        rho_p[i] = slope;
        q[i] = value * open * open * open;
    }
}
}

dispatched! {
/// `f = −s ∇·(τ∇P)`, `d = s Σ τ/d²`, `t` the mean conductance.
pub(super) fn balance_row(
    p: &[f64],
    p_south: &[f64],
    p_north: &[f64],
    east: &[f64],
    south: &[f64],
    north: &[f64],
    s: &[f64],
    (wx, wy): (f64, f64),
    f: &mut [f64],
    d: &mut [f64],
    t: &mut [f64],
) {
    let n = p.len();
    let (p_south, p_north, east) = (&p_south[..n], &p_north[..n], &east[..n]);
    let (south, north, s) = (&south[..n], &north[..n], &s[..n]);
    let (f, d, t) = (&mut f[..n], &mut d[..n], &mut t[..n]);
    for i in 1..n - 1 {
        let (w, e, so, no) = (east[i - 1], east[i], south[i], north[i]);
        let flow = wx * (e * (p[i + 1] - p[i]) + w * (p[i - 1] - p[i]))
            + wy * (no * (p_north[i] - p[i]) + so * (p_south[i] - p[i]));
        f[i] = -s[i] * flow;
        d[i] = s[i] * (wx * (e + w) + wy * (no + so));
        t[i] = 0.25 * (e + w + no + so);
    }
}
}

dispatched! {
/// Adds what is stored and convected to F, the deformation to D; the scale of the linear rows.
pub(super) fn finish_row(
    rho: &[f64],
    h: &[f64],
    c_star: &[f64],
    k00: f64,
    f: &mut [f64],
    d: &mut [f64],
    scale: &mut [f64],
) {
    let n = rho.len();
    let (h, c_star) = (&h[..n], &c_star[..n]);
    let (f, d, scale) = (&mut f[..n], &mut d[..n], &mut scale[..n]);
    for i in 1..n - 1 {
        f[i] += rho[i] * h[i] - c_star[i];
        d[i] += rho[i] * k00;
        scale[i] = (d[i] * k00).sqrt();
    }
}
}

dispatched! {
/// ∂(ρ̄H)/∂P and ∂(ρ̄H)/∂H.
pub(super) fn storage_row(rho: &[f64], rho_p: &[f64], h: &[f64], a_p: &mut [f32], a_h: &mut [f32]) {
    let n = rho.len();
    let (rho_p, h, a_p, a_h) = (&rho_p[..n], &h[..n], &mut a_p[..n], &mut a_h[..n]);
    for i in 0..n {
        a_p[i] = (rho_p[i] * h[i]) as f32;
        a_h[i] = rho[i] as f32;
    }
}
}

dispatched! {
/// Adds the flow through one face of every node: `own` are the derivatives of its conductance at the
/// node itself, `other` those at the neighbour.
pub(super) fn flow_row(
    tau: &[f64],
    own_by_p: &[f64],
    own_by_h: &[f64],
    other_by_p: &[f64],
    other_by_h: &[f64],
    p: &[f64],
    p_other: &[f64],
    s: &[f64],
    weight: f64,
    own_p: &mut [f32],
    own_h: &mut [f32],
    other_p: &mut [f32],
    other_h: &mut [f32],
) {
    let n = own_p.len();
    let (tau, own_by_p, own_by_h) = (&tau[..n], &own_by_p[..n], &own_by_h[..n]);
    let (other_by_p, other_by_h) = (&other_by_p[..n], &other_by_h[..n]);
    let (p, p_other, s) = (&p[..n], &p_other[..n], &s[..n]);
    let (own_h, other_p, other_h) = (&mut own_h[..n], &mut other_p[..n], &mut other_h[..n]);
    for i in 0..n {
        let w = s[i] * weight;
        let dp = p_other[i] - p[i];
        own_p[i] += (w * (tau[i] - own_by_p[i] * dp)) as f32;
        own_h[i] -= (w * own_by_h[i] * dp) as f32;
        other_p[i] = (-w * (tau[i] + other_by_p[i] * dp)) as f32;
        other_h[i] = (-w * other_by_h[i] * dp) as f32;
    }
}
}

dispatched! {
/// Divides a line by the row scale; zero where the node is not active.
pub(super) fn scale_row(row_scale: &[f64], active: &[bool], line: &mut [f32]) {
    let n = line.len();
    let (row_scale, active) = (&row_scale[..n], &active[..n]);
    for i in 0..n {
        let factor = if active[i] { 1.0 / row_scale[i] } else { 0.0 };
        line[i] *= factor as f32;
    }
}
}
