//! Sums of numbers that are given by their logarithms: ln Σ w e^a.

/// `ln Σ w e^a`, relative to the largest term; −∞ for no terms or terms that are all zero.
pub fn ln_sum(terms: impl IntoIterator<Item = (f64, f64)> + Clone) -> f64 {
    let top = terms
        .clone()
        .into_iter()
        .fold(f64::NEG_INFINITY, |top, (_, a)| top.max(a));
    if top == f64::NEG_INFINITY {
        return top;
    }
    let sum: f64 = terms.into_iter().map(|(w, a)| w * (a - top).exp()).sum();
    top + sum.ln()
}

/// Logarithms in a format that has no infinity: −∞ is left empty. For serde's `with`.
pub mod ln_list {
    use serde::{Deserialize, Deserializer, Serializer};

    /// Writes −∞ as nothing.
    ///
    /// # Errors
    /// Those of the serializer.
    pub fn serialize<S: Serializer>(logs: &[f64], to: S) -> Result<S::Ok, S::Error> {
        to.collect_seq(logs.iter().map(|ln| ln.is_finite().then_some(*ln)))
    }

    /// Reads nothing as −∞.
    ///
    /// # Errors
    /// Those of the deserializer.
    pub fn deserialize<'de, D: Deserializer<'de>>(from: D) -> Result<Vec<f64>, D::Error> {
        let logs = Vec::<Option<f64>>::deserialize(from)?;
        Ok(logs
            .into_iter()
            .map(|ln| ln.unwrap_or(f64::NEG_INFINITY))
            .collect())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn adds_what_does_not_fit_a_float() {
        let sum = ln_sum([(2.0, 1000.0), (1.0, 1000.0), (5.0, -1000.0)]);
        assert!((sum - (1000.0 + 3.0_f64.ln())).abs() < 1e-12);
        assert_eq!(ln_sum([]), f64::NEG_INFINITY);
        assert_eq!(ln_sum([(1.0, f64::NEG_INFINITY)]), f64::NEG_INFINITY);
    }
}
