//! The softer body yields: no pressure above its hardness, and what would exceed it flows for good.
//!
//! ```text
//! P ≤ P_H,   w ≥ 0,   (P_H − P) w = 0        film equation everywhere, with H = H0 + G + K P + w
//! one unknown a node   Q ≥ 0:   P = min(Q, P_H),   w = K00 (Q − P_H)⁺,   F(Q) ≥ 0,   F Q = 0
//! held nodes           Q − F/D > P_H:   P = P_H is known there, and the film is the unknown: F(H) = 0,
//!                      w = H − (H0 + G + K P),   never below zero
//! columns of a held node m   ∂F/∂P v_m  →  K00 ∂F/∂H x_m,   x = δH/K00;   it has no part in K v nor in the load
//! ```
//! | symbol | meaning | shape |
//! |---|---|---|
//! | P_H | hardness of the softer body over p_h | scalar |
//! | w | depth by which its surface yields for good in this step, film units | ny × nx |
//! | Q | pressure, and beyond P_H what the depth would be as pressure of the node alone | ny × nx |
//!
//! On a plateau of equal pressure nothing flows but with the surfaces, so the film there is what comes along the
//! characteristic, ρ̄H = C*, and the body makes room for it: an asperity under oil is flattened to its film, a dry one
//! to contact. What is natural for P ≥ 0 (`newton.rs`) stays so for Q: residual, merit and line search are the same.
//! The film as unknown, not w: F of a held node then sees its neighbours' films alone and not all pressures.
//!
//! The law is that of an elastic body whose surface flows freely at P_H (perfectly plastic, no hardening). Source: the dry
//! contact of Almqvist, Sahlin, Larsson and Glavatskih (2007), Tribology International 40, 574-579. What flows leaves:
//! it is not piled up beside the asperity, and no stress stays behind in the body. Tests: `tests/engine/yielding.rs`.

/// Hardness and what yields; the iterate's part that pressure, film and approach do not hold.
pub struct Yielding {
    /// P_H.
    pub hardness: f64,
    /// w.
    depth: Vec<f64>,
    /// Nodes whose pressure is known to be P_H in the linearisation at hand.
    held: Vec<bool>,
    /// Active nodes whose pressure is not known.
    pressed: Vec<bool>,
    any_held: bool,
    /// H of held nodes where the line search began, then where it looks.
    from: Vec<f64>,
    target: Vec<f64>,
}

impl Yielding {
    /// Buffers for `n` nodes.
    pub(super) fn new(n: usize, hardness: f64) -> Self {
        Self {
            hardness,
            depth: vec![0.0; n],
            held: vec![false; n],
            pressed: vec![false; n],
            any_held: false,
            from: vec![0.0; n],
            target: vec![0.0; n],
        }
    }

    /// w of the last step that was tried.
    pub fn depth(&self) -> &[f64] {
        &self.depth
    }

    /// A step begins: nothing has yielded in it yet.
    pub(super) fn begin(&mut self, p: &mut [f64]) {
        self.held.fill(false);
        self.any_held = false;
        for p in p {
            *p = p.min(self.hardness);
        }
    }

    /// Adds w to the film of an elastic evaluation.
    pub(super) fn add_to(&mut self, p: &[f64], h: &mut [f64]) {
        for (n, depth) in self.depth.iter_mut().enumerate() {
            let yields = self.held[n] && p[n] >= self.hardness;
            *depth = if yields {
                (self.target[n] - h[n]).max(0.0)
            } else {
                0.0
            };
            h[n] += *depth;
        }
    }

    /// Takes what a dry solution overlaps by at the hardness for w: the bodies touch there.
    pub(super) fn take_overlap(&mut self, p: &[f64], h: &mut [f64]) {
        for ((depth, h), &p) in self.depth.iter_mut().zip(h).zip(p) {
            let yields = p >= self.hardness && *h < 0.0;
            *depth = if yields { -*h } else { 0.0 };
            *h += *depth;
        }
    }

    /// Parts the active nodes into held and pressed; `fixed` is the change of pressure that is known.
    pub(super) fn split(
        &mut self,
        p: &[f64],
        f: &[f64],
        d: &[f64],
        k00: f64,
        active: &[bool],
        fixed: &mut [f32],
    ) {
        self.any_held = false;
        for n in 0..p.len() {
            let natural = p[n] + self.depth[n] / k00 - f[n] / d[n];
            let held = active[n] && natural > self.hardness;
            self.held[n] = held;
            self.pressed[n] = active[n] && !held;
            if held {
                self.any_held = true;
                fixed[n] = (self.hardness - p[n]) as f32;
            }
        }
    }

    /// The held nodes; `None`: there are none.
    pub(super) fn held(&self) -> Option<&[bool]> {
        self.any_held.then_some(&self.held[..])
    }

    /// The active nodes whose pressure is unknown.
    pub(super) fn pressed(&self) -> &[bool] {
        &self.pressed
    }

    /// The line search begins at film `h`.
    pub(super) fn accept(&mut self, h: &[f64]) {
        self.from.copy_from_slice(h);
    }

    /// Bounds a pressure that has gone the share `t` of a step from `old`, and moves the films of held nodes by as much
    /// (`v`: their change over K00); gives Σ|dP| and ΣP.
    pub(super) fn bound(
        &mut self,
        old: &[f64],
        v: &[f32],
        k00: f64,
        t: f64,
        p: &mut [f64],
    ) -> (f64, f64) {
        let (mut moved, mut total) = (0.0, 0.0);
        for (n, p) in p.iter_mut().enumerate() {
            if self.held[n] {
                *p = if t < 1.0 {
                    old[n] + t * (self.hardness - old[n])
                } else {
                    self.hardness
                };
                self.target[n] = self.from[n] + t * k00 * f64::from(v[n]);
            }
            *p = p.min(self.hardness);
            moved += (*p - old[n]).abs();
            total += *p;
        }
        (moved, total)
    }
}
