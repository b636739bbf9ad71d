//! Digests: FNV-1a, 64 bits (Fowler, Noll and Vo), of the crate `fnv`: against accidents, not against malice.

use std::hash::Hasher as _;

pub use ::fnv::FnvHasher;

/// The digest of bytes.
pub fn fnv(bytes: &[u8]) -> u64 {
    let mut digest = FnvHasher::default();
    digest.write(bytes);
    digest.finish()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_digest_is_the_standards() {
        // Test vectors of the authors.
        assert_eq!(fnv(b""), 0xcbf2_9ce4_8422_2325);
        assert_eq!(fnv(b"foobar"), 0x8594_4171_f739_67e8);
    }
}
