//! The key of a cell along a 3D Hilbert curve: Skilling's curve ("Programming the Hilbert curve",
//! 2004), which goes on in 24 orientations.
//!
//! Each octant of a cube takes its place on the curve by the cube's orientation, and then has an
//! orientation itself. So a table gives one octal digit of the key after another. Skilling's own
//! program asks for one bit of a coordinate after another, and nobody can predict the answers.

/// Bits per axis; three axes fill 63 bits of the key.
pub(super) const BITS: u32 = 21;

/// For each orientation of a cube, and each of its octants in the order of (x, y, z): the octant's
/// digit in the lowest three bits, and its orientation in those above.
#[rustfmt::skip]
const TURNS: [[u8; 8]; 24] = [
    [0o010, 0o021, 0o033, 0o002, 0o047, 0o056, 0o064, 0o005],
    [0o070, 0o107, 0o111, 0o126, 0o133, 0o024, 0o012, 0o015],
    [0o060, 0o001, 0o147, 0o156, 0o163, 0o022, 0o014, 0o025],
    [0o176, 0o201, 0o035, 0o032, 0o117, 0o120, 0o214, 0o003],
    [0o224, 0o053, 0o045, 0o042, 0o177, 0o200, 0o116, 0o121],
    [0o234, 0o055, 0o043, 0o052, 0o037, 0o006, 0o240, 0o151],
    [0o110, 0o127, 0o213, 0o004, 0o071, 0o106, 0o062, 0o065],
    [0o000, 0o253, 0o157, 0o114, 0o061, 0o072, 0o146, 0o075],
    [0o264, 0o217, 0o123, 0o270, 0o105, 0o066, 0o102, 0o141],
    [0o020, 0o173, 0o011, 0o112, 0o057, 0o074, 0o046, 0o115],
    [0o204, 0o137, 0o125, 0o016, 0o103, 0o220, 0o122, 0o041],
    [0o216, 0o067, 0o271, 0o140, 0o135, 0o164, 0o132, 0o013],
    [0o274, 0o153, 0o257, 0o260, 0o145, 0o142, 0o076, 0o101],
    [0o244, 0o155, 0o167, 0o026, 0o143, 0o152, 0o230, 0o051],
    [0o256, 0o261, 0o077, 0o100, 0o165, 0o162, 0o134, 0o023],
    [0o036, 0o175, 0o241, 0o172, 0o007, 0o254, 0o150, 0o113],
    [0o202, 0o031, 0o205, 0o246, 0o263, 0o210, 0o124, 0o277],
    [0o136, 0o017, 0o215, 0o034, 0o221, 0o040, 0o212, 0o063],
    [0o222, 0o233, 0o225, 0o044, 0o211, 0o030, 0o276, 0o247],
    [0o232, 0o235, 0o223, 0o054, 0o251, 0o266, 0o170, 0o207],
    [0o242, 0o245, 0o171, 0o206, 0o273, 0o154, 0o250, 0o267],
    [0o166, 0o255, 0o027, 0o174, 0o231, 0o252, 0o050, 0o073],
    [0o262, 0o161, 0o203, 0o130, 0o265, 0o236, 0o104, 0o227],
    [0o272, 0o243, 0o131, 0o160, 0o275, 0o144, 0o226, 0o237],
];

/// The table in one row. A byte cannot go beyond its end.
const TABLE: [u8; 256] = {
    let mut table = [0; 256];
    let mut place = 0;
    while place < 8 * TURNS.len() {
        table[place] = TURNS[place / 8][place % 8];
        place += 1;
    }
    table
};

/// The first digits of the key of a cell, one for each level. The numbers of the cell are below
/// 2^[`BITS`].
pub(super) fn hilbert_key(cell: [u32; 3], levels: u32) -> u64 {
    // The first octant is in the highest bits.
    let mut octants = interleave(cell) << 1;
    let mut turned = 0;
    let mut key = 0;
    for _ in 0..levels {
        turned = TABLE[(turned & !7 | (octants >> 61) as u8) as usize];
        octants <<= 3;
        key = key << 3 | u64::from(turned & 7);
    }
    key
}

/// Finds keys two levels at a time. For each orientation and each octant of an octant: the two digits in
/// the lowest six bits, and the orientation in those above.
pub(crate) struct Pairs([u16; 64 * 32]);

impl Pairs {
    pub(crate) fn new() -> Self {
        let mut pairs = [0; 64 * 32];
        for (place, pair) in pairs.iter_mut().enumerate().take(64 * TURNS.len()) {
            let outer = TABLE[place >> 3];
            let inner = TABLE[(outer & !7 | place as u8 & 7) as usize];
            *pair = u16::from(inner & !7) << 3 | u16::from((outer & 7) << 3 | inner & 7);
        }
        Self(pairs)
    }

    /// The same as [`hilbert_key`].
    #[inline]
    pub(super) fn key(&self, cell: [u32; 3], levels: u32) -> u64 {
        let mut octants = interleave(cell) << 1;
        let (mut turned, mut key) = (0, 0);
        if levels % 2 == 1 {
            let first = u16::from(TABLE[(octants >> 61) as usize]);
            octants <<= 3;
            (turned, key) = (first << 3, u64::from(first & 7));
        }
        for _ in 0..levels / 2 {
            turned = self.0[(turned & !63 | (octants >> 58) as u16) as usize % (64 * 32)];
            octants <<= 6;
            key = key << 6 | u64::from(turned & 63);
        }
        key
    }
}

#[inline]
fn interleave(x: [u32; 3]) -> u64 {
    spread(x[0]) << 2 | spread(x[1]) << 1 | spread(x[2])
}

/// Puts two zero bits between any two of the low 21 bits.
fn spread(x: u32) -> u64 {
    let mut x = u64::from(x);
    x = (x | x << 32) & 0x001f_0000_0000_ffff;
    x = (x | x << 16) & 0x001f_0000_ff00_00ff;
    x = (x | x << 8) & 0x100f_00f0_0f00_f00f;
    x = (x | x << 4) & 0x10c3_0c30_c30c_30c3;
    (x | x << 2) & 0x1249_2492_4924_9249
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::base::random::Random;

    /// Skilling's transform: coordinates to the transposed Hilbert index, whose interleaved bits
    /// are the key.
    fn transposed(mut x: [u32; 3]) -> [u32; 3] {
        for bit in (1..BITS).rev().map(|place| 1 << place) {
            for axis in 0..3 {
                if x[axis] & bit != 0 {
                    x[0] ^= bit - 1;
                } else {
                    let swap = (x[0] ^ x[axis]) & (bit - 1);
                    x[0] ^= swap;
                    x[axis] ^= swap;
                }
            }
        }
        x[1] ^= x[0];
        x[2] ^= x[1];
        let bits = (1..BITS).map(|place| 1 << place);
        let gray = bits.filter(|bit| x[2] & bit != 0);
        let gray = gray.fold(0, |gray, bit: u32| gray ^ (bit - 1));
        x.map(|axis| axis ^ gray)
    }

    #[test]
    fn the_table_gives_the_keys_of_the_transform() {
        let pairs = Pairs::new();
        let mut random = Random::new(3);
        for _ in 0..10_000 {
            let cell = [0; 3].map(|_: u32| random.below(1 << BITS) as u32);
            let key = interleave(transposed(cell));
            for levels in [0, 1, 12, BITS] {
                let first = key >> (3 * (BITS - levels));
                assert_eq!(hilbert_key(cell, levels), first, "{cell:?} {levels}");
                assert_eq!(pairs.key(cell, levels), first, "{cell:?} {levels}");
            }
        }
    }
}
