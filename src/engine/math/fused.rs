//! `a · b + c`, rounded once where the processor can.
//!
//! WebAssembly has no such operation (its relaxed vectors may have, and not on every machine the same): there it would be a
//! library call for each number, so that product and sum are rounded apart.

/// Numbers with a fused multiply-add.
pub(crate) trait Fused {
    /// `self · b + c`.
    fn fused(self, b: Self, c: Self) -> Self;
}

macro_rules! fused {
    ($number:ty) => {
        impl Fused for $number {
            #[inline(always)]
            fn fused(self, b: Self, c: Self) -> Self {
                if cfg!(target_arch = "wasm32") {
                    self * b + c
                } else {
                    self.mul_add(b, c)
                }
            }
        }
    };
}

fused!(f32);
fused!(f64);
