//! An oil by its grade: viscosity at a temperature and the pressure coefficient, as data sheets give them.
//!
//! ```text
//! log log(ν + 0.7) = A − B log T                       through (40 °C, ν₄₀ = VG) and (100 °C, ν₁₀₀): ASTM D341
//! L = aY² + bY + c,  H = dY² + eY + f                  Y = ν₁₀₀: ASTM D2270, table X2.1
//! VI ≤ 100:  VI = 100 (L − ν₄₀)/(L − H)                VI > 100:  Y^N = H/ν₄₀,  VI = 100 + (10^N − 1)/0.00715
//! η = ν ρ,   ρ = 880 kg/m³ − 0.7 (θ − 15 °C)           α = 0.010471 mm²/N (η/mPa s)^0.1348: AGMA 925-A03, mineral oil
//! ```
//! | symbol | meaning | unit |
//! |---|---|---|
//! | VG | viscosity grade, ν at 40 °C (ISO 3448: ± 10 %) | mm²/s |
//! | VI | viscosity index | |
//! | θ, T | temperature | °C, K |
//!
//! ν₁₀₀ is found from VG and VI by bisection. The correlation of α is the one that gear and bearing standards calculate films
//! with (ISO/TR 15144-1 has the same numbers). Measured at ambient pressure, α of twelve mineral oils at three temperatures is
//! 1.10 to 1.60 times as large, 1.34 on average (a test compares; Stachowiak and Batchelor 2005, table 2.3): a film, as about
//! the root of α, may be a sixth thicker.

/// a to f of ASTM D2270, table X2.1, from the Y that stands before them.
#[rustfmt::skip]
const INDEX: [(f64, [f64; 6]); 16] = [
    (2.0, [1.14673, 1.7576, -0.109, 0.84155, 1.5521, -0.077]),
    (3.8, [3.38095, -15.4952, 33.196, 0.78571, 1.7929, -0.183]),
    (4.4, [2.5000, -7.2143, 13.812, 0.82143, 1.5679, 0.119]),
    (5.0, [0.10100, 16.6350, -45.469, 0.04985, 9.1613, -18.557]),
    (6.4, [3.35714, -23.5643, 78.466, 0.22619, 7.7369, -16.656]),
    (7.0, [0.01191, 21.4750, -72.870, 0.79762, -0.7321, 14.610]),
    (7.7, [0.41858, 16.1558, -56.040, 0.05794, 10.5156, -28.240]),
    (9.0, [0.88779, 7.5527, -16.600, 0.26665, 6.7015, -10.810]),
    (12.0, [0.76720, 10.7972, -38.180, 0.20073, 8.4658, -22.490]),
    (15.0, [0.97305, 5.3135, -2.200, 0.28889, 5.9741, -4.930]),
    (18.0, [0.97256, 5.2500, -0.980, 0.24504, 7.4160, -16.730]),
    (22.0, [0.91413, 7.4759, -21.820, 0.20323, 9.1267, -34.230]),
    (28.0, [0.87031, 9.7157, -50.770, 0.18411, 10.1015, -46.750]),
    (40.0, [0.84703, 12.6752, -133.310, 0.17029, 11.4866, -80.620]),
    (55.0, [0.85921, 11.1009, -83.190, 0.17130, 11.3680, -76.940]),
    (70.0, [0.83531, 14.6731, -216.246, 0.16841, 11.8493, -96.947]),
];

/// Viscosity index of solvent-refined mineral oils, in which grades are usually tabled.
pub const USUAL_INDEX: f64 = 95.0;
/// 0 °C, K.
const ZERO_K: f64 = 273.15;

/// A mineral oil by its grade.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct OilGrade {
    /// VG, mm²/s at 40 °C.
    pub vg: f64,
    /// VI.
    pub viscosity_index: f64,
}

/// VI of an oil of kinematic viscosities `at_40` and `at_100`, mm²/s; `at_100` at least 2.
pub fn viscosity_index(at_40: f64, at_100: f64) -> f64 {
    let y = at_100;
    let row = INDEX.iter().rev().find(|(from, _)| *from <= y);
    let [a, b, c, d, e, f] = row.unwrap_or(&INDEX[0]).1;
    let (low, high) = ((a * y + b) * y + c, (d * y + e) * y + f);
    if at_40 >= high {
        100.0 * (low - at_40) / (low - high)
    } else {
        let n = (high / at_40).log10() / y.log10();
        100.0 + (10_f64.powf(n) - 1.0) / 0.00715
    }
}

impl OilGrade {
    /// Kinematic viscosity at 100 °C, mm²/s; `None`: the index is not defined so thin (below 2 mm²/s).
    pub fn at_100(&self) -> Option<f64> {
        let (mut low, mut high) = (INDEX[0].0, self.vg);
        let index = |at_100: f64| viscosity_index(self.vg, at_100);
        if high <= low || index(low) > self.viscosity_index {
            return None;
        }
        for _ in 0..100 {
            let middle = 0.5 * (low + high);
            if index(middle) < self.viscosity_index {
                low = middle;
            } else {
                high = middle;
            }
        }
        Some(0.5 * (low + high))
    }

    /// Kinematic viscosity at a temperature, mm²/s; `None` as of [`OilGrade::at_100`].
    pub fn kinematic(&self, temperature_c: f64) -> Option<f64> {
        let place = |viscosity: f64| (viscosity + 0.7).log10().log10();
        let log_k = |temperature_c: f64| (temperature_c + ZERO_K).log10();
        let (warm, hot) = (place(self.vg), place(self.at_100()?));
        let slope = (warm - hot) / (log_k(100.0) - log_k(40.0));
        let here = warm - slope * (log_k(temperature_c) - log_k(40.0));
        Some(10_f64.powf(10_f64.powf(here)) - 0.7)
    }

    /// Viscosity at a temperature, Pa s; `None` as of [`OilGrade::at_100`].
    pub fn viscosity_pa_s(&self, temperature_c: f64) -> Option<f64> {
        Some(1e-6 * self.kinematic(temperature_c)? * density_kg_m3(temperature_c))
    }
}

/// Of a mineral oil, kg/m³; grades differ by ± 2 %.
pub fn density_kg_m3(temperature_c: f64) -> f64 {
    880.0 - 0.7 * (temperature_c - 15.0)
}

/// Pressure coefficient of a mineral oil of that viscosity at its temperature, 1/Pa.
pub fn pressure_coefficient_per_pa(viscosity_pa_s: f64) -> f64 {
    0.010471e-6 * (1e3 * viscosity_pa_s).powf(0.1348)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The standard's own examples (ASTM D2270, 5.1.4 and 6.1.4), before they are rounded to whole numbers.
    #[test]
    fn index_of_the_standard_s_examples() {
        for (at_40, at_100, index) in [(73.30, 8.86, 92.43), (22.83, 5.05, 156.37)] {
            let found = viscosity_index(at_40, at_100);
            assert!((found - index).abs() < 0.15, "{found} not {index}");
        }
    }

    /// A slip of a digit in the table would be a step between its ranges.
    #[test]
    fn ranges_of_the_table_meet() {
        for pair in INDEX.windows(2) {
            let y = pair[1].0;
            let at = |[a, b, c]: [f64; 3]| (a * y + b) * y + c;
            for half in [0, 3] {
                let [one, other] = [0, 1].map(|k| at([0, 1, 2].map(|n| pair[k].1[half + n])));
                assert!((one / other - 1.0).abs() < 2e-3, "{y}: {one} {other}");
            }
        }
    }

    /// A published table of grades (index 95): typical viscosities at 100 °C, most printed to half a unit.
    #[test]
    fn grades_at_a_hundred_degrees() {
        for (vg, at_100) in [
            (32.0, 5.5),
            (68.0, 8.5),
            (100.0, 11.4),
            (150.0, 14.5),
            (220.0, 19.0),
            (320.0, 24.5),
        ] {
            let oil = OilGrade {
                vg,
                viscosity_index: USUAL_INDEX,
            };
            let found = oil.at_100().unwrap_or_default();
            println!("VG {vg}: {found:.2} mm²/s at 100 °C, table {at_100}");
            assert!(
                (found - at_100).abs() < (0.03 * at_100).max(0.25),
                "{vg}: {found}"
            );
            assert!((viscosity_index(vg, found) - USUAL_INDEX).abs() < 1e-6);
            // What D341 is drawn through.
            for (temperature_c, expected) in [(40.0, vg), (100.0, found)] {
                let there = oil.kinematic(temperature_c).unwrap_or_default();
                assert!((there / expected - 1.0).abs() < 1e-9);
            }
        }
        let thin = OilGrade {
            vg: 2.2,
            viscosity_index: 95.0,
        };
        assert_eq!(thin.at_100(), None);
    }

    /// Measured at 30, 60 and 100 °C (Stachowiak and Batchelor 2005, table 2.3): mPa s and 1/GPa, mineral oils.
    #[test]
    fn pressure_coefficients_of_measured_oils() {
        #[rustfmt::skip]
        let measured = [
            (153.0, 23.7), (34.0, 20.5), (9.1, 15.8), (250.0, 25.0), (50.5, 21.3), (12.6, 17.6), (810.0, 34.0), (135.0, 28.0),
            (26.8, 22.0), (18.6, 20.0), (6.3, 16.0), (2.4, 13.0), (45.0, 28.0), (12.0, 20.0), (3.9, 16.0), (107.0, 29.6),
            (23.3, 22.8), (6.4, 17.8), (122.0, 27.0), (26.3, 21.6), (7.3, 17.5), (171.0, 28.0), (31.0, 23.0), (7.5, 18.0),
            (30.7, 25.7), (8.6, 20.3), (3.1, 15.4), (165.0, 33.0), (30.0, 23.8), (6.8, 16.0), (310.0, 34.6), (44.2, 26.3),
            (9.4, 19.5), (2000.0, 41.5), (180.0, 29.4), (24.0, 25.0),
        ];
        let ratios = measured
            .map(|(viscosity, alpha)| 1e-9 * alpha / pressure_coefficient_per_pa(1e-3 * viscosity));
        let mean = ratios.iter().sum::<f64>() / ratios.len() as f64;
        let ends = ratios
            .iter()
            .fold([f64::MAX, f64::MIN], |[a, b], &r| [a.min(r), b.max(r)]);
        println!(
            "measured over correlation: {mean:.3} on average, {:.2} to {:.2}",
            ends[0], ends[1]
        );
        assert!((mean - 1.34).abs() < 0.01 && ends[0] > 1.09 && ends[1] < 1.61);
    }
}
