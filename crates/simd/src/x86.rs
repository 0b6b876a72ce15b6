//! SSE2, AVX2 and AVX-512 on x86-64.
//!
//! The vector types can be made only through a token of their instruction set, and a token exists only where the processor has it: that is
//! why every intrinsic here may be called. Loads and stores check the length of their slice first.

use std::arch::x86_64::*;

use super::{Simd, always};
pub use avx512::{Avx512, F16, I16, M16};

/// Makes the token type, the three vector types, their operators and the operations that have the same form everywhere.
macro_rules! vectors {
    (
        $(#[$doc:meta])* $token:ident, $n:literal, $tile:expr, $f:ident($fv:ty), $i:ident($iv:ty), $m:ident($mv:ty);
        $(float $ftrait:ident $fname:ident $fop:ident;)*
        $(int $itrait:ident $iname:ident $iop:ident;)*
        $(mask $mtrait:ident $mname:ident $mop:ident;)*
        lanes { $($body:tt)* }
    ) => {
        $(#[$doc])*
        #[derive(Debug, Clone, Copy)]
        pub struct $token(());
        /// Floats side by side.
        #[derive(Debug, Clone, Copy)]
        pub struct $f($fv);
        /// Integers side by side.
        #[derive(Debug, Clone, Copy)]
        pub struct $i($iv);
        /// Yes or no for each lane.
        #[derive(Debug, Clone, Copy)]
        pub struct $m($mv);
        $(impl std::ops::$ftrait for $f {
            type Output = Self;
            #[inline(always)]
            fn $fname(self, other: Self) -> Self {
                // SAFETY: the operands exist, so the processor has the instruction set (see the head of the file).
                Self(unsafe { $fop(self.0, other.0) })
            }
        })*
        $(impl std::ops::$itrait for $i {
            type Output = Self;
            #[inline(always)]
            fn $iname(self, other: Self) -> Self {
                // SAFETY: as above.
                Self(unsafe { $iop(self.0, other.0) })
            }
        })*
        $(impl std::ops::$mtrait for $m {
            type Output = Self;
            #[inline(always)]
            fn $mname(self, other: Self) -> Self {
                // SAFETY: as above.
                Self(unsafe { $mop(self.0, other.0) })
            }
        })*
        impl Simd for $token {
            const N: usize = $n;
            const TILE: [usize; 2] = $tile;
            type F = $f;
            type I = $i;
            type M = $m;
            $($body)*
        }
    };
}

/// A method of [`Simd`] that is one expression of intrinsics.
macro_rules! simple {
    ($($name:ident ($($argument:ident: $type:ty),*) -> $out:ident = $value:expr;)*) => { $(
        #[inline(always)]
        fn $name(self, $($argument: $type),*) -> Self::$out {
            // SAFETY: `self` exists, so the processor has the instruction set (see the head of the file).
            unsafe { $value }
        }
    )* };
}

/// Loads and stores: `$bits` is the type that the pointer is cast to.
macro_rules! memory {
    ($n:literal, $f:ident, $i:ident, $loadf:ident, $storef:ident, $loadi:ident, $storei:ident, $bits:ty) => {
        #[inline(always)]
        fn load(self, from: &[f32]) -> $f {
            let from = &from[..$n];
            // SAFETY: the instruction set is there, and the slice has as many elements as are read; alignment is not asked for.
            $f(unsafe { $loadf(from.as_ptr()) })
        }
        #[inline(always)]
        fn store(self, x: $f, to: &mut [f32]) {
            let to = &mut to[..$n];
            // SAFETY: as for `load`.
            unsafe { $storef(to.as_mut_ptr(), x.0) }
        }
        #[inline(always)]
        fn iload(self, from: &[u32]) -> $i {
            let from = &from[..$n];
            // SAFETY: as for `load`.
            $i(unsafe { $loadi(from.as_ptr().cast::<$bits>()) })
        }
        #[inline(always)]
        fn istore(self, x: $i, to: &mut [u32]) {
            let to = &mut to[..$n];
            // SAFETY: as for `load`.
            unsafe { $storei(to.as_mut_ptr().cast::<$bits>(), x.0) }
        }
    };
}

/// Shifts by a constant.
macro_rules! shifts {
    ($i:ident, $left:ident, $right:ident $(, $as:ty)?) => {
        #[inline(always)]
        fn shl<const BY: i32>(self, x: $i) -> $i {
            // SAFETY: `self` exists, so the processor has the instruction set.
            $i(unsafe { $left(x.0, shifts!(@count BY $(, $as)?)) })
        }
        #[inline(always)]
        fn shr<const BY: i32>(self, x: $i) -> $i {
            // SAFETY: as above.
            $i(unsafe { $right(x.0, shifts!(@count BY $(, $as)?)) })
        }
    };
    (@count $by:ident) => { _mm_cvtsi32_si128($by) };
}

/// Quadruples, by transposing 4 × 4 blocks: `$row` reads four floats for each 128 bits of a vector.
macro_rules! quads {
    ($f:ident, |$at:ident, $apart:ident| $row:expr, $low:ident, $high:ident, $shuffle:ident) => {
        #[inline(always)]
        unsafe fn quads(self, from: *const f32, stride: usize) -> [$f; 4] {
            // SAFETY: `self` exists, so the processor has the instruction set; the caller promises the floats.
            unsafe {
                let row = always!(|first: usize| {
                    let ($at, $apart) = (from.add(first * stride), stride * 4);
                    $row
                });
                let (a, b, c, d) = (row(0), row(1), row(2), row(3));
                let (xy0, xy1, zw0, zw1) = ($low(a, b), $low(c, d), $high(a, b), $high(c, d));
                [
                    $f($shuffle::<0b01_00_01_00>(xy0, xy1)),
                    $f($shuffle::<0b11_10_11_10>(xy0, xy1)),
                    $f($shuffle::<0b01_00_01_00>(zw0, zw1)),
                    $f($shuffle::<0b11_10_11_10>(zw0, zw1)),
                ]
            }
        }
    };
}

/// Triples by the same transposition in the 128 bits of each vector, where a vector's third holds `xyzx yzxy zxyz` of four triples.
macro_rules! triples {
    ($n:literal, $f:ident, |$at:ident| $load:expr, |$x:ident, $to:ident| $store:expr, $shuffle:ident) => {
        #[inline(always)]
        fn triples(self, from: &[[f32; 3]]) -> [$f; 3] {
            let from = &from[..$n];
            // SAFETY: `self` exists, so the processor has the instruction set; the slice has as many floats as are read.
            unsafe {
                let load = always!(|third: usize| {
                    let $at = from.as_ptr().cast::<f32>().add(third * 4);
                    $load
                });
                // x0 y0 z0 x1, y1 z1 x2 y2, z2 x3 y3 z3.
                let (a, b, c) = (load(0), load(1), load(2));
                let (x2y2x3y3, y0z0y1z1) = ($shuffle::<0b10_01_11_10>(b, c), $shuffle::<0b01_00_10_01>(a, b));
                [
                    $f($shuffle::<0b10_00_11_00>(a, x2y2x3y3)),
                    $f($shuffle::<0b11_01_10_00>(y0z0y1z1, x2y2x3y3)),
                    $f($shuffle::<0b11_00_11_01>(y0z0y1z1, c)),
                ]
            }
        }
        #[inline(always)]
        fn set_triples(self, [x, y, z]: [$f; 3], to: &mut [[f32; 3]]) {
            let to = &mut to[..$n];
            // SAFETY: as above, for writing.
            unsafe {
                let mut store = always!(|third: usize, $x| {
                    let $to = to.as_mut_ptr().cast::<f32>().add(third * 4);
                    $store
                });
                let (x0x2y0y2, y1y3z1z3, z0z2x1x3) =
                    ($shuffle::<0b10_00_10_00>(x.0, y.0), $shuffle::<0b11_01_11_01>(y.0, z.0), $shuffle::<0b11_01_10_00>(z.0, x.0));
                store(0, $shuffle::<0b10_00_10_00>(x0x2y0y2, z0z2x1x3));
                store(1, $shuffle::<0b11_01_10_00>(y1y3z1z3, x0x2y0y2));
                store(2, $shuffle::<0b11_01_11_01>(z0z2x1x3, y1y3z1z3));
            }
        }
    };
}

vectors! {
    /// Four lanes; every x86-64 has them.
    Sse2, 4, [4, 1], F4(__m128), I4(__m128i), M4(__m128i);
    float Add add _mm_add_ps;
    float Sub sub _mm_sub_ps;
    float Mul mul _mm_mul_ps;
    float Div div _mm_div_ps;
    int Add add _mm_add_epi32;
    int Sub sub _mm_sub_epi32;
    int BitAnd bitand _mm_and_si128;
    int BitOr bitor _mm_or_si128;
    mask BitAnd bitand _mm_and_si128;
    mask BitOr bitor _mm_or_si128;
    lanes {
        simple! {
            splat(x: f32) -> F = F4(_mm_set1_ps(x));
            isplat(x: i32) -> I = I4(_mm_set1_epi32(x));
            iota() -> I = I4(_mm_setr_epi32(0, 1, 2, 3));
            min(a: F4, b: F4) -> F = F4(_mm_min_ps(a.0, b.0));
            max(a: F4, b: F4) -> F = F4(_mm_max_ps(a.0, b.0));
            sqrt(x: F4) -> F = F4(_mm_sqrt_ps(x.0));
            lt(a: F4, b: F4) -> M = M4(_mm_castps_si128(_mm_cmplt_ps(a.0, b.0)));
            ilt(a: I4, b: I4) -> M = M4(_mm_cmplt_epi32(a.0, b.0));
            iselect(which: M4, yes: I4, no: I4) -> I = I4(_mm_or_si128(_mm_and_si128(which.0, yes.0), _mm_andnot_si128(which.0, no.0)));
            trunc(x: F4) -> I = I4(_mm_cvttps_epi32(x.0));
            float(x: I4) -> F = F4(_mm_cvtepi32_ps(x.0));
            mul16(a: I4, b: I4) -> I = I4(_mm_mullo_epi16(a.0, b.0));
            dot16(a: I4, b: I4) -> I = I4(_mm_madd_epi16(a.0, b.0));
            bits(x: F4) -> I = I4(_mm_castps_si128(x.0));
            float_bits(x: I4) -> F = F4(_mm_castsi128_ps(x.0));
            // SSE2 multiplies two of four lanes; the odd ones are brought down, multiplied, and woven in again.
            imul(a: I4, b: I4) -> I = {
                let even = _mm_mul_epu32(a.0, b.0);
                let odd = _mm_mul_epu32(_mm_srli_si128::<4>(a.0), _mm_srli_si128::<4>(b.0));
                I4(_mm_unpacklo_epi32(_mm_shuffle_epi32::<0b1000>(even), _mm_shuffle_epi32::<0b1000>(odd)))
            };
        }
        #[inline(always)]
        fn select(self, which: M4, yes: F4, no: F4) -> F4 {
            self.float_bits(self.iselect(which, self.bits(yes), self.bits(no)))
        }
        memory!(4, F4, I4, _mm_loadu_ps, _mm_storeu_ps, _mm_loadu_si128, _mm_storeu_si128, __m128i);
        shifts!(I4, _mm_sll_epi32, _mm_srl_epi32);
        #[inline(always)]
        fn gather(self, from: &[u32], index: I4) -> I4 {
            let (mut indices, mut values) = ([0u32; 4], [0u32; 4]);
            self.istore(index, &mut indices);
            for (value, index) in values.iter_mut().zip(indices) {
                *value = from[(index as usize).min(from.len() - 1)];
            }
            self.iload(&values)
        }
        #[inline(always)]
        fn pairs(self, from: &[u32], index: I4) -> [I4; 2] {
            let (mut indices, mut first, mut second) = ([0u32; 4], [0u32; 4], [0u32; 4]);
            self.istore(index, &mut indices);
            for k in 0..4 {
                let at = (indices[k] as usize).min(from.len() - 2);
                (first[k], second[k]) = (from[at], from[at + 1]);
            }
            [self.iload(&first), self.iload(&second)]
        }
        #[inline(always)]
        unsafe fn tile(self, from: *const u32, _: usize) -> I4 {
            // SAFETY: SSE2 is there, the caller promises the row.
            I4(unsafe { _mm_loadu_si128(from.cast()) })
        }
        #[inline(always)]
        unsafe fn set_tile(self, x: I4, to: *mut u32, _: usize) {
            // SAFETY: as above.
            unsafe { _mm_storeu_si128(to.cast(), x.0) }
        }
        quads!(F4, |at, _apart| _mm_loadu_ps(at), _mm_unpacklo_ps, _mm_unpackhi_ps, _mm_shuffle_ps);
        triples!(4, F4, |at| _mm_loadu_ps(at), |x, to| _mm_storeu_ps(to, x), _mm_shuffle_ps);
        #[inline(always)]
        fn mask_bits(self, m: M4) -> u32 {
            // SAFETY: SSE2 is there.
            unsafe { _mm_movemask_ps(_mm_castsi128_ps(m.0)) as u32 }
        }
    }
}

impl Sse2 {
    /// The token; SSE2 is part of x86-64.
    pub(super) fn new() -> Self {
        Self(())
    }
}

vectors! {
    /// Eight lanes.
    Avx2, 8, [4, 2], F8(__m256), I8(__m256i), M8(__m256i);
    float Add add _mm256_add_ps;
    float Sub sub _mm256_sub_ps;
    float Mul mul _mm256_mul_ps;
    float Div div _mm256_div_ps;
    int Add add _mm256_add_epi32;
    int Sub sub _mm256_sub_epi32;
    int BitAnd bitand _mm256_and_si256;
    int BitOr bitor _mm256_or_si256;
    mask BitAnd bitand _mm256_and_si256;
    mask BitOr bitor _mm256_or_si256;
    lanes {
        simple! {
            splat(x: f32) -> F = F8(_mm256_set1_ps(x));
            isplat(x: i32) -> I = I8(_mm256_set1_epi32(x));
            iota() -> I = I8(_mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7));
            min(a: F8, b: F8) -> F = F8(_mm256_min_ps(a.0, b.0));
            max(a: F8, b: F8) -> F = F8(_mm256_max_ps(a.0, b.0));
            sqrt(x: F8) -> F = F8(_mm256_sqrt_ps(x.0));
            lt(a: F8, b: F8) -> M = M8(_mm256_castps_si256(_mm256_cmp_ps::<_CMP_LT_OQ>(a.0, b.0)));
            ilt(a: I8, b: I8) -> M = M8(_mm256_cmpgt_epi32(b.0, a.0));
            iselect(which: M8, yes: I8, no: I8) -> I = I8(_mm256_blendv_epi8(no.0, yes.0, which.0));
            select(which: M8, yes: F8, no: F8) -> F = F8(_mm256_blendv_ps(no.0, yes.0, _mm256_castsi256_ps(which.0)));
            trunc(x: F8) -> I = I8(_mm256_cvttps_epi32(x.0));
            float(x: I8) -> F = F8(_mm256_cvtepi32_ps(x.0));
            mul16(a: I8, b: I8) -> I = I8(_mm256_mullo_epi16(a.0, b.0));
            dot16(a: I8, b: I8) -> I = I8(_mm256_madd_epi16(a.0, b.0));
            bits(x: F8) -> I = I8(_mm256_castps_si256(x.0));
            float_bits(x: I8) -> F = F8(_mm256_castsi256_ps(x.0));
            imul(a: I8, b: I8) -> I = I8(_mm256_mullo_epi32(a.0, b.0));
        }
        memory!(8, F8, I8, _mm256_loadu_ps, _mm256_storeu_ps, _mm256_loadu_si256, _mm256_storeu_si256, __m256i);
        shifts!(I8, _mm256_sll_epi32, _mm256_srl_epi32);
        #[inline(always)]
        fn gather(self, from: &[u32], index: I8) -> I8 {
            let last = u32::try_from(from.len() - 1).unwrap_or(u32::MAX).min(i32::MAX as u32);
            // SAFETY: AVX2 is there; every index is held at the last element, and fits in 31 bits, so that all reads are inside `from`.
            unsafe {
                let index = _mm256_min_epu32(index.0, _mm256_set1_epi32(last as i32));
                I8(_mm256_i32gather_epi32::<4>(from.as_ptr().cast::<i32>(), index))
            }
        }
        #[inline(always)]
        fn pairs(self, from: &[u32], index: I8) -> [I8; 2] {
            let last = u32::try_from(from.len() - 2).unwrap_or(u32::MAX).min(i32::MAX as u32);
            // SAFETY: AVX2 is there; every index is held at the last but one, so that both elements that are read are inside `from`. One element of
            // 64 bits costs what one of 32 does.
            unsafe {
                let (index, from) = (_mm256_min_epu32(index.0, _mm256_set1_epi32(last as i32)), from.as_ptr().cast::<i64>());
                let low = _mm256_castsi256_ps(_mm256_i32gather_epi64::<4>(from, _mm256_castsi256_si128(index)));
                let high = _mm256_castsi256_ps(_mm256_i32gather_epi64::<4>(from, _mm256_extracti128_si256::<1>(index)));
                // Halves are woven together as 0 1 4 5 2 3 6 7.
                let first = _mm256_castps_si256(_mm256_shuffle_ps::<0b10_00_10_00>(low, high));
                let second = _mm256_castps_si256(_mm256_shuffle_ps::<0b11_01_11_01>(low, high));
                [first, second].map(|x| I8(_mm256_permute4x64_epi64::<0b11_01_10_00>(x)))
            }
        }
        #[inline(always)]
        fn floor(self, x: F8) -> F8 {
            // SAFETY: AVX2 is there.
            F8(unsafe { _mm256_floor_ps(x.0) })
        }
        #[inline(always)]
        unsafe fn tile(self, from: *const u32, pitch: usize) -> I8 {
            // SAFETY: AVX2 is there, the caller promises the rows.
            I8(unsafe { _mm256_loadu2_m128i(from.add(pitch).cast(), from.cast()) })
        }
        #[inline(always)]
        unsafe fn set_tile(self, x: I8, to: *mut u32, pitch: usize) {
            // SAFETY: as above.
            unsafe { _mm256_storeu2_m128i(to.add(pitch).cast(), to.cast(), x.0) }
        }
        quads!(F8, |at, apart| _mm256_loadu2_m128(at.add(apart), at), _mm256_unpacklo_ps, _mm256_unpackhi_ps, _mm256_shuffle_ps);
        triples!(8, F8, |at| _mm256_loadu2_m128(at.add(12), at), |x, to| _mm256_storeu2_m128(to.add(12), to, x), _mm256_shuffle_ps);
        #[inline(always)]
        fn mask_bits(self, m: M8) -> u32 {
            // SAFETY: AVX2 is there.
            unsafe { _mm256_movemask_ps(_mm256_castsi256_ps(m.0)) as u32 }
        }
    }
}

impl Avx2 {
    /// The token, where the processor has AVX2.
    pub fn detect() -> Option<Self> {
        std::arch::is_x86_feature_detected!("avx2").then_some(Self(()))
    }
}

mod avx512;
