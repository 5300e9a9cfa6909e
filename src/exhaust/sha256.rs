//! SHA-256 (FIPS 180-4), to name the code that a certificate speaks about.
//!
//! Written out since the alternative is a dependency for forty lines. It is for identification: it
//! takes the whole message at once and makes no attempt at speed or at constant time.

/// The fractional parts of the cube roots of the first 64 primes, and of the square roots of the
/// first 8, in 32 bits: FIPS 180-4, sections 4.2.2 and 5.3.3. Computed instead of copied.
fn constants() -> ([u32; 64], [u32; 8]) {
    let mut primes = (2u128..).filter(|n| (2..*n).all(|d| n % d != 0));
    let primes: [u128; 64] = std::array::from_fn(|_| primes.next().unwrap_or_default());
    // The largest r with r^k <= p 2^(32 k), without its whole part.
    let root = |p: u128, k: u32| {
        let target = p << (32 * k);
        let (mut low, mut high) = (0u128, 1u128 << 40);
        while low + 1 < high {
            let middle = (low + high) / 2;
            if middle.pow(k) <= target {
                low = middle;
            } else {
                high = middle;
            }
        }
        low as u32
    };
    (primes.map(|p| root(p, 3)), std::array::from_fn(|i| root(primes[i], 2)))
}

/// The digest of a message as 64 hexadecimal digits.
#[must_use]
pub fn hex(message: &[u8]) -> String {
    let (k, mut state) = constants();
    let mut padded = message.to_vec();
    padded.push(0x80);
    while padded.len() % 64 != 56 {
        padded.push(0);
    }
    padded.extend((message.len() as u64 * 8).to_be_bytes());
    for block in padded.as_chunks::<64>().0 {
        compress(&mut state, block, &k);
    }
    state.iter().map(|word| format!("{word:08x}")).collect()
}

/// One block: FIPS 180-4, section 6.2.2.
fn compress(state: &mut [u32; 8], block: &[u8; 64], k: &[u32; 64]) {
    let mut w = [0u32; 64];
    for (word, bytes) in w.iter_mut().zip(block.as_chunks::<4>().0) {
        *word = u32::from_be_bytes(*bytes);
    }
    for t in 16..64 {
        let s0 = w[t - 15].rotate_right(7) ^ w[t - 15].rotate_right(18) ^ (w[t - 15] >> 3);
        let s1 = w[t - 2].rotate_right(17) ^ w[t - 2].rotate_right(19) ^ (w[t - 2] >> 10);
        w[t] = w[t - 16].wrapping_add(s0).wrapping_add(w[t - 7]).wrapping_add(s1);
    }
    let [mut a, mut b, mut c, mut d, mut e, mut f, mut g, mut h] = *state;
    for t in 0..64 {
        let s1 = e.rotate_right(6) ^ e.rotate_right(11) ^ e.rotate_right(25);
        let choice = (e & f) ^ (!e & g);
        let t1 = h.wrapping_add(s1).wrapping_add(choice).wrapping_add(k[t]).wrapping_add(w[t]);
        let s0 = a.rotate_right(2) ^ a.rotate_right(13) ^ a.rotate_right(22);
        let majority = (a & b) ^ (a & c) ^ (b & c);
        let t2 = s0.wrapping_add(majority);
        (h, g, f, e, d, c, b, a) = (g, f, e, d.wrapping_add(t1), c, b, a, t1.wrapping_add(t2));
    }
    for (word, add) in state.iter_mut().zip([a, b, c, d, e, f, g, h]) {
        *word = word.wrapping_add(add);
    }
}

#[cfg(test)]
mod tests {
    use super::hex;

    /// The examples of FIPS 180-2, appendix B, and the empty message.
    #[test]
    fn published_digests() {
        let cases = [
            ("", "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855"),
            ("abc", "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad"),
            (
                "abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq",
                "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1",
            ),
        ];
        for (message, digest) in cases {
            assert_eq!(hex(message.as_bytes()), digest, "{message:?}");
        }
    }
}
