//! Vectors of `f32` and `i32` that give the same bits on every instruction set.
//!
//! # How a kernel is written
//!
//! Once, generic over [`Simd`]: a value `l` of that trait stands for an instruction set, `L::N` is its number of lanes, and its methods are the
//! operations. [`kernel!`] compiles the function for each instruction set and makes another one that takes a [`SimdLevel`] and calls the right copy.
//!
//! ```
//! use sinew_simd::{Simd, SimdLevel, kernel};
//!
//! kernel! {
//!     /// Writes the larger of two numbers.
//!     fn larger(a: &[f32], b: &[f32], to: &mut [f32]) = larger_in_lanes
//! }
//!
//! #[inline(always)]
//! fn larger_in_lanes<L: Simd>(l: L, a: &[f32], b: &[f32], to: &mut [f32]) {
//!     for ((a, b), to) in a.chunks_exact(L::N).zip(b.chunks_exact(L::N)).zip(to.chunks_exact_mut(L::N)) {
//!         l.store(l.max(l.load(a), l.load(b)), to);
//!     }
//! }
//!
//! let (a, b) = ([1.0; 16], [2.0; 16]);
//! for level in SimdLevel::all() {
//!     let mut found = [0.0; 16];
//!     larger(level, &a, &b, &mut found);
//!     assert_eq!(found, b, "{}", level.name());
//! }
//! ```
//!
//! Lists are padded to a multiple of 16 or their rest is done by other means: no operation reads or writes less than a whole vector.
//!
//! # Why the bits are the same
//!
//! All operations are those that IEEE 754 rounds exactly: no fused multiply-add, no approximate reciprocals. Each lane is on its own, so a pixel gets
//! the same bits whether 1, 4, 8 or 16 of them are computed at a time. `f32` stays correct where a compiler's own vectorizer would have to be trusted to
//! see the pattern; that was tried first and lost the masked stores.
//!
//! # Why everything is inlined
//!
//! An intrinsic can only be inlined where its instruction set is switched on, so every function and closure between a kernel's entry and its intrinsics
//! has to dissolve; one that does not costs a factor of fifty. Hence `#[inline(always)]` on kernels, [`each`] and [`map`] instead of
//! `std::array::from_fn` and `array::map`, and [`always!`] round closures.
//!
//! # Why it is safe
//!
//! A value of an instruction set's type (`Avx2`, `Avx512`) is the proof that the processor has it: only [`SimdLevel`] makes one, after it has asked.

mod scalar;
#[cfg(target_arch = "x86_64")]
mod x86;

use std::ops::{Add, BitAnd, BitOr, Div, Mul, Sub};

pub use scalar::{Int, Scalar};
#[cfg(target_arch = "x86_64")]
pub use x86::{Avx2, Avx512, F4, F8, F16, I4, I8, I16, M4, M8, M16, Sse2};

/// `N` pixels or vertices side by side.
pub trait Simd: Copy {
    /// How many.
    const N: usize;
    /// Columns and rows of a tile: the lanes side by side in short rows, for triangles that are narrow.
    const TILE: [usize; 2];
    /// Whether a tile is more than one row.
    const TALL: bool = Self::TILE[1] > 1;
    /// Floats.
    type F: Copy + Add<Output = Self::F> + Sub<Output = Self::F> + Mul<Output = Self::F> + Div<Output = Self::F>;
    /// Integers; sums wrap.
    type I: Copy + Add<Output = Self::I> + Sub<Output = Self::I> + BitAnd<Output = Self::I> + BitOr<Output = Self::I>;
    /// Yes or no.
    type M: Copy + BitAnd<Output = Self::M> + BitOr<Output = Self::M>;

    /// The same number in every lane.
    fn splat(self, x: f32) -> Self::F;
    /// The same integer in every lane.
    fn isplat(self, x: i32) -> Self::I;
    /// 0, 1, 2, …
    fn iota(self) -> Self::I;
    /// The first `N` of `from`, which has at least that many.
    fn load(self, from: &[f32]) -> Self::F;
    /// Writes to the first `N` of `to`, which has at least that many.
    fn store(self, x: Self::F, to: &mut [f32]);
    /// As [`Simd::load`], for integers.
    fn iload(self, from: &[u32]) -> Self::I;
    /// As [`Simd::store`], for integers.
    fn istore(self, x: Self::I, to: &mut [u32]);
    /// `a < b ? a : b`, so the second where one is NaN.
    fn min(self, a: Self::F, b: Self::F) -> Self::F;
    /// `a > b ? a : b`, so the second where one is NaN.
    fn max(self, a: Self::F, b: Self::F) -> Self::F;
    /// The square root, rounded exactly.
    fn sqrt(self, x: Self::F) -> Self::F;
    /// `a < b`; not where one is NaN.
    fn lt(self, a: Self::F, b: Self::F) -> Self::M;
    /// Signed.
    fn ilt(self, a: Self::I, b: Self::I) -> Self::M;
    /// `which ? yes : no`.
    fn select(self, which: Self::M, yes: Self::F, no: Self::F) -> Self::F;
    /// As [`Simd::select`], for integers.
    fn iselect(self, which: Self::M, yes: Self::I, no: Self::I) -> Self::I;
    /// Towards zero; `i32::MIN` where it does not fit.
    fn trunc(self, x: Self::F) -> Self::I;
    /// The nearest float.
    fn float(self, x: Self::I) -> Self::F;
    /// The bits of a float.
    fn bits(self, x: Self::F) -> Self::I;
    /// The float of these bits.
    fn float_bits(self, x: Self::I) -> Self::F;
    /// Shifts to the left by `BY` bits.
    fn shl<const BY: i32>(self, x: Self::I) -> Self::I;
    /// Zeros come in.
    fn shr<const BY: i32>(self, x: Self::I) -> Self::I;
    /// The low 32 bits of the product.
    fn imul(self, a: Self::I, b: Self::I) -> Self::I;
    /// The two 16-bit halves of each lane multiplied on their own, the low 16 bits of either product.
    fn mul16(self, a: Self::I, b: Self::I) -> Self::I;
    /// The two 16-bit halves of each lane multiplied as signed numbers, and the products added: what [`Simd::imul`] gives for small numbers, in half the
    /// time.
    fn dot16(self, a: Self::I, b: Self::I) -> Self::I;
    /// `from[index]`; an index beyond the end reads the last, and `from` is not empty.
    fn gather(self, from: &[u32], index: Self::I) -> Self::I;
    /// `from[index]` and `from[index + 1]`; an index too large for that reads the last two, and `from` has at least two.
    fn pairs(self, from: &[u32], index: Self::I) -> [Self::I; 2];
    /// A tile, its rows `pitch` apart.
    ///
    /// # Safety
    /// All of the tile's rows can be read from `from` on.
    unsafe fn tile(self, from: *const u32, pitch: usize) -> Self::I;
    /// Writes a tile.
    ///
    /// # Safety
    /// All of the tile's rows can be written from `to` on.
    unsafe fn set_tile(self, x: Self::I, to: *mut u32, pitch: usize);
    /// `N` quadruples that stand `stride` apart, as one vector a place.
    ///
    /// # Safety
    /// From each quadruple on four floats can be read.
    unsafe fn quads(self, from: *const f32, stride: usize) -> [Self::F; 4];
    /// The first `N` triples of `from`, which has at least that many, as one vector a coordinate.
    fn triples(self, from: &[[f32; 3]]) -> [Self::F; 3];
    /// Writes `N` triples one after the other.
    fn set_triples(self, x: [Self::F; 3], to: &mut [[f32; 3]]);
    /// Bit `i` says lane `i`.
    fn mask_bits(self, m: Self::M) -> u32;

    /// Whether it holds in any lane.
    #[inline(always)]
    fn any(self, m: Self::M) -> bool {
        self.mask_bits(m) != 0
    }
    /// Holds `x` between `low` and `high`.
    #[inline(always)]
    fn clamp(self, x: Self::F, low: f32, high: f32) -> Self::F {
        self.min(self.max(x, self.splat(low)), self.splat(high))
    }
    /// Down to a whole number, for |x| < 2³¹; −0 stays −0.
    #[inline(always)]
    fn floor(self, x: Self::F) -> Self::F {
        let whole = self.float(self.trunc(x));
        let below = self.select(self.lt(x, whole), whole - self.splat(1.0), whole);
        self.float_bits(self.bits(below) | (self.bits(x) & self.isplat(i32::MIN)))
    }
    /// Without the sign.
    #[inline(always)]
    fn abs(self, x: Self::F) -> Self::F {
        self.float_bits(self.bits(x) & self.isplat(i32::MAX))
    }
    /// As [`Simd::abs`], for integers.
    #[inline(always)]
    fn iabs(self, x: Self::I) -> Self::I {
        self.iselect(self.ilt(x, self.isplat(0)), self.isplat(0) - x, x)
    }
}

/// `std::array::from_fn` that is certain to be inlined. An intrinsic can only be inlined where its instruction set is switched on, so every function and
/// closure between a kernel's entry and its intrinsics has to dissolve; one that does not costs a factor of fifty.
#[inline(always)]
pub fn each<T: Copy, const N: usize>(mut value: impl FnMut(usize) -> T) -> [T; N] {
    let mut all = [value(0); N];
    for (i, slot) in all.iter_mut().enumerate().skip(1) {
        *slot = value(i);
    }
    all
}

/// `array::map`, inlined in the same way.
#[inline(always)]
pub fn map<T: Copy, U: Copy, const N: usize>(from: [T; N], mut to: impl FnMut(T) -> U) -> [U; N] {
    let mut all = [to(from[0]); N];
    for i in 1..N {
        all[i] = to(from[i]);
    }
    all
}

/// A closure that is certain to be inlined: `always!(|x| …)`. The attribute is allowed on arguments of calls only, hence [`same`].
#[macro_export]
macro_rules! always {
    ($closure:expr) => {
        $crate::same(
            #[inline(always)]
            $closure,
        )
    };
}

/// Gives back what it is given.
#[inline(always)]
pub fn same<T>(value: T) -> T {
    value
}

/// An instruction set that this processor has.
///
/// ```
/// use sinew_simd::SimdLevel;
///
/// // The widest, or the one that the environment variable SINEW_SIMD asks for.
/// assert!(SimdLevel::NAMES.contains(&SimdLevel::detect().name()));
/// // Scalar code runs everywhere.
/// assert!(SimdLevel::named("scalar").is_some());
/// assert!(SimdLevel::named("mmx").is_none());
/// ```
#[derive(Debug, Clone, Copy)]
pub enum SimdLevel {
    /// One number at a time.
    Scalar(Scalar),
    /// Four side by side.
    #[cfg(target_arch = "x86_64")]
    Sse2(Sse2),
    /// Eight side by side.
    #[cfg(target_arch = "x86_64")]
    Avx2(Avx2),
    /// Sixteen side by side.
    #[cfg(target_arch = "x86_64")]
    Avx512(Avx512),
}

impl SimdLevel {
    /// All that this processor has, slowest first.
    pub fn all() -> Vec<Self> {
        let mut all = vec![Self::Scalar(Scalar)];
        #[cfg(target_arch = "x86_64")]
        {
            all.push(Self::Sse2(Sse2::new()));
            all.extend(Avx2::detect().map(Self::Avx2));
            all.extend(Avx512::detect().map(Self::Avx512));
        }
        all
    }

    /// The name in `SINEW_SIMD`.
    pub fn name(self) -> &'static str {
        match self {
            Self::Scalar(_) => "scalar",
            #[cfg(target_arch = "x86_64")]
            Self::Sse2(_) => "sse2",
            #[cfg(target_arch = "x86_64")]
            Self::Avx2(_) => "avx2",
            #[cfg(target_arch = "x86_64")]
            Self::Avx512(_) => "avx512",
        }
    }

    /// The one that `name` asks for, if it is there.
    pub fn named(name: &str) -> Option<Self> {
        Self::all().into_iter().find(|level| level.name() == name)
    }

    /// The names of all that there are, on any processor.
    pub const NAMES: [&str; 4] = ["scalar", "sse2", "avx2", "avx512"];

    /// The one that the environment variable `SINEW_SIMD` asks for, else the widest. [`SimdLevel::asked`] tells whether what it asks for is there.
    pub fn detect() -> Self {
        let asked = Self::asked().ok().flatten();
        asked.or_else(|| Self::all().pop()).unwrap_or(Self::Scalar(Scalar))
    }

    /// What the environment variable `SINEW_SIMD` asks for; `None` where it is not set, and its value as an error where it names nothing that is there.
    pub fn asked() -> Result<Option<Self>, String> {
        let Some(value) = std::env::var_os("SINEW_SIMD") else { return Ok(None) };
        let name = value.to_string_lossy().into_owned();
        Self::named(&name).map(Some).ok_or(name)
    }
}

/// Compiles a function that is generic over [`Simd`] for each instruction set and makes the function that chooses between them:
/// `kernel!(pub fn name<'a>(argument: Type, …) = generic_name)` calls `generic_name(lanes, argument, …)`.
///
/// Functions that are rarely used and long to compile can do without one more copy: `kernel!(narrow fn …)` uses AVX2 where AVX-512 is asked for.
#[macro_export]
macro_rules! kernel {
    ($(#[$doc:meta])* narrow $visible:vis fn $name:ident $(<$($life:lifetime),*>)? ($($argument:ident: $type:ty),* $(,)?) = $generic:path) => {
        $(#[$doc])*
        #[allow(clippy::too_many_arguments, reason = "the kernel has as many arguments as its caller gives it, and one more")]
        $visible fn $name $(<$($life),*>)? (level: $crate::SimdLevel, $($argument: $type),*) {
            #[cfg(target_arch = "x86_64")]
            #[allow(clippy::too_many_arguments, reason = "the kernel has as many arguments as its caller gives it, and one more")]
            #[target_feature(enable = "avx2")]
            fn avx2 $(<$($life),*>)? (lanes: $crate::Avx2, $($argument: $type),*) {
                $generic(lanes, $($argument),*)
            }
            match level {
                $crate::SimdLevel::Scalar(lanes) => $generic(lanes, $($argument),*),
                #[cfg(target_arch = "x86_64")]
                $crate::SimdLevel::Sse2(lanes) => $generic(lanes, $($argument),*),
                // SAFETY: a value of the type `Avx2` exists only where the processor has AVX2.
                #[cfg(target_arch = "x86_64")]
                $crate::SimdLevel::Avx2(lanes) => unsafe { avx2(lanes, $($argument),*) },
                // SAFETY: as above.
                #[cfg(target_arch = "x86_64")]
                $crate::SimdLevel::Avx512(lanes) => unsafe { avx2(lanes.half(), $($argument),*) },
            }
        }
    };
    ($(#[$doc:meta])* $visible:vis fn $name:ident $(<$($life:lifetime),*>)? ($($argument:ident: $type:ty),* $(,)?) = $generic:path) => {
        $(#[$doc])*
        #[allow(clippy::too_many_arguments, reason = "the kernel has as many arguments as its caller gives it, and one more")]
        $visible fn $name $(<$($life),*>)? (level: $crate::SimdLevel, $($argument: $type),*) {
            #[cfg(target_arch = "x86_64")]
            #[allow(clippy::too_many_arguments, reason = "the kernel has as many arguments as its caller gives it, and one more")]
            #[target_feature(enable = "avx2")]
            fn avx2 $(<$($life),*>)? (lanes: $crate::Avx2, $($argument: $type),*) {
                $generic(lanes, $($argument),*)
            }
            #[cfg(target_arch = "x86_64")]
            #[allow(clippy::too_many_arguments, reason = "the kernel has as many arguments as its caller gives it, and one more")]
            #[target_feature(enable = "avx512f,avx512bw,avx512dq,avx512vl")]
            fn avx512 $(<$($life),*>)? (lanes: $crate::Avx512, $($argument: $type),*) {
                $generic(lanes, $($argument),*)
            }
            match level {
                $crate::SimdLevel::Scalar(lanes) => $generic(lanes, $($argument),*),
                #[cfg(target_arch = "x86_64")]
                $crate::SimdLevel::Sse2(lanes) => $generic(lanes, $($argument),*),
                // SAFETY: a value of the type `Avx2` exists only where the processor has AVX2.
                #[cfg(target_arch = "x86_64")]
                $crate::SimdLevel::Avx2(lanes) => unsafe { avx2(lanes, $($argument),*) },
                // SAFETY: as above, for AVX-512.
                #[cfg(target_arch = "x86_64")]
                $crate::SimdLevel::Avx512(lanes) => unsafe { avx512(lanes, $($argument),*) },
            }
        }
    };
}

#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;

#[cfg(test)]
mod tests {
    use super::*;

    /// Puts many awkward numbers through every operation and returns all bits that come out.
    fn exercise<L: Simd>(l: L, out: &mut Vec<u32>) {
        let odd =
            [0.0, -0.0, 1.0, -1.5, 0.3, 1e30, -1e30, f32::INFINITY, f32::NEG_INFINITY, f32::NAN, 1e-40, 2.5e9, -7.75, 255.49, 3.0e-7, 16.0];
        let table: Vec<u32> = (0..37).map(|i| i * 7).collect();
        let floats = |first: usize| l.load(&std::array::from_fn::<f32, 16, _>(|i| odd[(first + i) % odd.len()]));
        // Each lane count walks the same list from the start, so the outputs line up.
        for shift in 0..odd.len() {
            let (mut results, mut tiles): (Vec<Vec<u32>>, Vec<u32>) = (Vec::new(), Vec::new());
            for start in (0..16).step_by(L::N) {
                let (a, b) = (floats(start), floats(start + shift));
                let (i, j) = (l.bits(a), l.bits(b));
                let small = l.iota() + l.isplat(start as i32 + shift as i32);
                let no_nan = |x: L::F| l.bits(l.select(l.lt(x, l.splat(f32::INFINITY)), x, l.splat(7.0)));
                let all = [
                    no_nan(a + b),
                    no_nan(a - b),
                    no_nan(a * b),
                    no_nan(a / b),
                    l.bits(l.min(a, b)),
                    l.bits(l.max(a, b)),
                    no_nan(l.sqrt(l.abs(a))),
                    l.trunc(a),
                    l.bits(l.float(i)),
                    l.iselect(l.lt(a, b), i, j),
                    l.iselect(l.ilt(i, j) | l.ilt(j, l.isplat(0)), i + j, i - j),
                    l.shl::<3>(i) | (l.shr::<5>(j) & small),
                    l.imul(i, j),
                    l.mul16(i, j),
                    l.dot16(i, j),
                    l.gather(&table, small),
                    l.pairs(&table, small)[0],
                    l.pairs(&table, small)[1],
                    l.pairs(&table[..2], i)[1],
                    l.bits(l.floor(l.clamp(a, -1e6, 1e6))),
                ];
                for (k, value) in all.into_iter().enumerate() {
                    let mut lanes = [0u32; 16];
                    l.istore(value, &mut lanes);
                    if results.len() <= k {
                        results.push(Vec::new());
                    }
                    results[k].extend(&lanes[..L::N]);
                }
                // The table as rows of eight, a tile read at the lane's place in a 4 × 4 one and written back elsewhere.
                let [columns, rows] = L::TILE;
                assert_eq!(columns * rows, L::N);
                let mut copy = [0u32; 40];
                let at = start / 4 * 8 + start % 4;
                // SAFETY: the last of 4 × 4 lanes is at 3 · 8 + 3.
                unsafe { l.set_tile(l.tile(table[at..].as_ptr(), 8), copy[at..].as_mut_ptr(), 8) };
                for lane in 0..L::N {
                    tiles.push(copy[at + lane / columns * 8 + lane % columns]);
                }
                // Quadruples five apart; three of each packed, and read again.
                let spread = odd.repeat(6);
                // SAFETY: 16 quadruples five apart end before 96.
                let four = unsafe { l.quads(spread[start * 5..].as_ptr(), 5) };
                let mut packed = [[0.0f32; 3]; 17];
                l.set_triples([four[0], four[1], four[2]], &mut packed[..L::N]);
                let again = l.triples(&packed[..L::N]);
                for (k, vector) in four.into_iter().chain(again).enumerate() {
                    let mut lanes = [0u32; 16];
                    l.istore(l.bits(vector), &mut lanes);
                    for i in 0..L::N {
                        assert_eq!(lanes[i], spread[(start + i) * 5 + k % 4].to_bits());
                        assert!(k > 2 || packed[i][k].to_bits() == lanes[i]);
                    }
                }
                assert_eq!(packed[L::N..].concat().iter().sum::<f32>(), 0.0);
                let mask = l.mask_bits(l.lt(a, b));
                for lane in 0..L::N {
                    out.push(mask >> lane & 1);
                }
            }
            out.extend(results.concat());
            out.extend(tiles);
        }
    }
    kernel!(fn exercise_all(out: &mut Vec<u32>) = exercise);

    #[test]
    fn every_instruction_set_gives_the_scalar_bits() {
        let mut expected = Vec::new();
        exercise_all(SimdLevel::Scalar(Scalar), &mut expected);
        for level in SimdLevel::all() {
            let mut found = Vec::new();
            exercise_all(level, &mut found);
            assert_eq!(found, expected, "{}", level.name());
        }
    }
}
