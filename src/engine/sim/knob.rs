//! Where the catalogue has what a knob turns.

use super::{Quantity, named};
use crate::scene::Knob;

const WHERE: [&Quantity; Knob::ALL.len()] = {
    let mut all = [named("step"); Knob::ALL.len()];
    let mut k = 0;
    while k < all.len() {
        all[k] = named(Knob::ALL[k].line().quantity);
        k += 1;
    }
    all
};

const WHERE_TO: [Option<&Quantity>; Knob::ALL.len()] = {
    let mut all = [None; Knob::ALL.len()];
    let mut k = 0;
    while k < all.len() {
        if let Some(name) = Knob::ALL[k].line().target {
            all[k] = Some(named(name));
        }
        k += 1;
    }
    all
};

impl Knob {
    /// Where it is.
    pub fn quantity(self) -> &'static Quantity {
        WHERE[self as usize]
    }

    /// Where it is going, if frames tell.
    pub fn target_quantity(self) -> Option<&'static Quantity> {
        WHERE_TO[self as usize]
    }
}
