//! The keys of `[life]`.

use super::key::Kind::{Choice, Number};
use super::key::Need::{Defaulted, Optional};
use super::key::{Key, key};
use super::life::{BodyChoice, CycleBasis, DamageMaps, LifeModel, Spread};

/// Keys of `[life]` in printed order.
#[rustfmt::skip] // one line a key
pub(super) const LIFE: &[Key] = &[
    key("model", "", Choice(LifeModel::KEYS), Defaulted, "life model"),
    key("stress_exponent", "", Number(1.0, 40.0), Defaulted, "c: assumption, not from the paper"),
    key("weibull_slope", "", Number(0.3, 10.0), Defaulted, "e: assumption, not from the paper"),
    key("survival", "", Number(0.001, 0.999), Defaulted, "probability of survival Ps; cancels out of relative lives"),
    key("cycles", "", Choice(CycleBasis::KEYS), Defaulted, "how cycles enter: each by the damage it does, in loading cycles of the faster body; one n for the volume, every contact a whole cycle (Pu, Zhu, Wang & Wang 2016); or each by its peak of effective stress"),
    key("body", "", Choice(BodyChoice::KEYS), Defaulted, "whose life it is, in that body's own loading cycles (with cycles = \"damage\" in those of the faster body)"),
    key("depth_exponent", "", Number(0.0, 4.0), Defaulted, "h of Lundberg-Palmgren and Ioannides-Harris"),
    key("cut_off_a", "a", Number(1e-3, 1.0), Defaulted, "depth above which z^-h no longer grows; at a rough surface it would diverge"),
    key("limit_pa", "Pa", Number(0.0, 1e10), Defaulted, "fatigue limit of the effective stress (Ioannides-Harris); 0: none; ISO 281 takes 9e8 of von Mises"),
    key("normal_weight", "", Number(0.0, 2.0), Defaulted, "weight of the hydrostatic (Dang Van) or normal (Findley) stress: assumption"),
    key("spread", "", Choice(Spread::KEYS), Defaulted, "spread of the life over the cycle bases, or over all models too"),
    key("damage_map", "", Choice(DamageMaps::KEYS), Defaulted, "bodies for which damage is mapped over depth and along the surface"),
    key("calibration_cycles", "cycles", Number(1.0, 1e15), Optional("lives stay relative"), "loading cycles that the smooth, frictionless contact survives at calibration_pressure_pa"),
    key("calibration_pressure_pa", "Pa", Number(1e6, 1e10), Optional("lives stay relative"), "Hertz pressure of the calibration point, same radii and materials"),
    key("calibration_survival", "", Number(0.001, 0.999), Defaulted, "probability of survival of the calibration point"),
    key("iso_load_ratio", "", Number(0.0, 5.0), Optional("no a_ISO beside the result"), "e_C C_u/P of ISO 281:2007, contamination times load limit over load"),
];
