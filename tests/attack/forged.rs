//! A recording that nobody made, for the attack and for the fuzzer.

/// A recording that holds these notes alone, their digests right.
pub(crate) fn forged_recording<'a>(notes: impl Iterator<Item = &'a [u8]>) -> Vec<u8> {
    let mut bytes = b"RRF2\0\x24\x03\0\x01\x02\0\0".to_vec();
    for body in notes {
        let digest = asperity_engine::files::fnv(body);
        let head = format!("asperity note 2 {digest:016x} {} ", body.len());
        let mut message = vec![5 << 3 | 2];
        let mut left = head.len() + body.len();
        while left >= 0x80 {
            message.push(left as u8 | 0x80);
            left >>= 7;
        }
        message.push(left as u8);
        message.extend(head.as_bytes());
        message.extend(body);
        bytes.extend(2_u64.to_le_bytes());
        bytes.extend((message.len() as u64).to_le_bytes());
        bytes.extend(message);
    }
    bytes
}
