//! Sixteen lanes: AVX-512 with its foundation and the byte and word instructions, which came together in every processor since 2017.

use std::arch::x86_64::*;

use super::super::{Simd, always, each};

vectors! {
    /// Sixteen lanes.
    Avx512, 16, [4, 4], F16(__m512), I16(__m512i), M16(__mmask16);
    float Add add _mm512_add_ps;
    float Sub sub _mm512_sub_ps;
    float Mul mul _mm512_mul_ps;
    float Div div _mm512_div_ps;
    int Add add _mm512_add_epi32;
    int Sub sub _mm512_sub_epi32;
    int BitAnd bitand _mm512_and_si512;
    int BitOr bitor _mm512_or_si512;
    mask BitAnd bitand _kand_mask16;
    mask BitOr bitor _kor_mask16;
    lanes {
        simple! {
            splat(x: f32) -> F = F16(_mm512_set1_ps(x));
            isplat(x: i32) -> I = I16(_mm512_set1_epi32(x));
            iota() -> I = I16(_mm512_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15));
            min(a: F16, b: F16) -> F = F16(_mm512_min_ps(a.0, b.0));
            max(a: F16, b: F16) -> F = F16(_mm512_max_ps(a.0, b.0));
            sqrt(x: F16) -> F = F16(_mm512_sqrt_ps(x.0));
            lt(a: F16, b: F16) -> M = M16(_mm512_cmp_ps_mask::<_CMP_LT_OQ>(a.0, b.0));
            ilt(a: I16, b: I16) -> M = M16(_mm512_cmplt_epi32_mask(a.0, b.0));
            iselect(which: M16, yes: I16, no: I16) -> I = I16(_mm512_mask_blend_epi32(which.0, no.0, yes.0));
            select(which: M16, yes: F16, no: F16) -> F = F16(_mm512_mask_blend_ps(which.0, no.0, yes.0));
            trunc(x: F16) -> I = I16(_mm512_cvttps_epi32(x.0));
            float(x: I16) -> F = F16(_mm512_cvtepi32_ps(x.0));
            floor(x: F16) -> F = F16(_mm512_roundscale_ps::<_MM_FROUND_TO_NEG_INF>(x.0));
            mul16(a: I16, b: I16) -> I = I16(_mm512_mullo_epi16(a.0, b.0));
            dot16(a: I16, b: I16) -> I = I16(_mm512_madd_epi16(a.0, b.0));
            bits(x: F16) -> I = I16(_mm512_castps_si512(x.0));
            float_bits(x: I16) -> F = F16(_mm512_castsi512_ps(x.0));
            imul(a: I16, b: I16) -> I = I16(_mm512_mullo_epi32(a.0, b.0));
        }
        memory!(16, F16, I16, _mm512_loadu_ps, _mm512_storeu_ps, _mm512_loadu_si512, _mm512_storeu_si512, __m512i);
        shifts!(I16, _mm512_sll_epi32, _mm512_srl_epi32);
        #[inline(always)]
        fn gather(self, from: &[u32], index: I16) -> I16 {
            let last = u32::try_from(from.len() - 1).unwrap_or(u32::MAX).min(i32::MAX as u32);
            // SAFETY: AVX-512 is there; every index is held at the last element, and fits in 31 bits, so that all reads are inside `from`.
            unsafe {
                let index = _mm512_min_epu32(index.0, _mm512_set1_epi32(last as i32));
                I16(_mm512_i32gather_epi32::<4>(index, from.as_ptr().cast::<i32>()))
            }
        }
        #[inline(always)]
        fn pairs(self, from: &[u32], index: I16) -> [I16; 2] {
            let last = u32::try_from(from.len() - 2).unwrap_or(u32::MAX).min(i32::MAX as u32);
            // SAFETY: AVX-512 is there; every index is held at the last but one, so that both elements that are read are inside `from`.
            unsafe {
                let (index, from) = (_mm512_min_epu32(index.0, _mm512_set1_epi32(last as i32)), from.as_ptr().cast::<i64>());
                let low = _mm512_i32gather_epi64::<4>(_mm512_castsi512_si256(index), from.cast());
                let high = _mm512_i32gather_epi64::<4>(_mm512_extracti64x4_epi64::<1>(index), from.cast());
                let even = _mm512_setr_epi32(0, 2, 4, 6, 8, 10, 12, 14, 16, 18, 20, 22, 24, 26, 28, 30);
                let odd = _mm512_add_epi32(even, _mm512_set1_epi32(1));
                [I16(_mm512_permutex2var_epi32(low, even, high)), I16(_mm512_permutex2var_epi32(low, odd, high))]
            }
        }
        #[inline(always)]
        unsafe fn tile(self, from: *const u32, pitch: usize) -> I16 {
            // SAFETY: AVX-512 is there, the caller promises the rows.
            unsafe {
                let row = |k: usize| _mm_loadu_si128(from.add(k * pitch).cast());
                let low = _mm256_inserti128_si256::<1>(_mm256_castsi128_si256(row(0)), row(1));
                let high = _mm256_inserti128_si256::<1>(_mm256_castsi128_si256(row(2)), row(3));
                I16(_mm512_inserti64x4::<1>(_mm512_castsi256_si512(low), high))
            }
        }
        #[inline(always)]
        unsafe fn set_tile(self, x: I16, to: *mut u32, pitch: usize) {
            // SAFETY: as above.
            unsafe {
                _mm_storeu_si128(to.cast(), _mm512_castsi512_si128(x.0));
                _mm_storeu_si128(to.add(pitch).cast(), _mm512_extracti32x4_epi32::<1>(x.0));
                _mm_storeu_si128(to.add(2 * pitch).cast(), _mm512_extracti32x4_epi32::<2>(x.0));
                _mm_storeu_si128(to.add(3 * pitch).cast(), _mm512_extracti32x4_epi32::<3>(x.0));
            }
        }
        quads!(
            F16,
            |at, apart| {
                let low = _mm256_loadu2_m128(at.add(apart), at);
                let high = _mm256_loadu2_m128(at.add(apart * 3), at.add(apart * 2));
                _mm512_insertf32x8::<1>(_mm512_castps256_ps512(low), high)
            },
            _mm512_unpacklo_ps,
            _mm512_unpackhi_ps,
            _mm512_shuffle_ps
        );
        // One permutation picks any 16 of 32 floats, so two make a vector out of three.
        #[inline(always)]
        fn triples(self, from: &[[f32; 3]]) -> [F16; 3] {
            let from = &from[..16];
            // SAFETY: AVX-512 is there; the slice has as many floats as are read.
            unsafe {
                let at = from.as_ptr().cast::<f32>();
                let (a, b, c) = (_mm512_loadu_ps(at), _mm512_loadu_ps(at.add(16)), _mm512_loadu_ps(at.add(32)));
                each::<_, 3>(always!(|k: usize| {
                    let two = _mm512_permutex2var_ps(a, _mm512_loadu_si512(OUT_OF_TWO[k].as_ptr().cast()), b);
                    F16(_mm512_permutex2var_ps(two, _mm512_loadu_si512(OUT_OF_THIRD[k].as_ptr().cast()), c))
                }))
            }
        }
        #[inline(always)]
        fn set_triples(self, [x, y, z]: [F16; 3], to: &mut [[f32; 3]]) {
            let to = &mut to[..16];
            // SAFETY: as above, for writing.
            unsafe {
                let at = to.as_mut_ptr().cast::<f32>();
                for k in 0..3 {
                    let two = _mm512_permutex2var_ps(x.0, _mm512_loadu_si512(TWO_IN[k].as_ptr().cast()), y.0);
                    let all = _mm512_permutex2var_ps(two, _mm512_loadu_si512(THIRD_IN[k].as_ptr().cast()), z.0);
                    _mm512_storeu_ps(at.add(k * 16), all);
                }
            }
        }
        #[inline(always)]
        fn mask_bits(self, m: M16) -> u32 {
            u32::from(m.0)
        }
    }
}

// Indices of the permutations between triples and vectors: below 16 from the first operand, from 16 on from the second.
static OUT_OF_TWO: Indices = indices(Step::OutOfTwo);
static OUT_OF_THIRD: Indices = indices(Step::OutOfThird);
static TWO_IN: Indices = indices(Step::TwoIn);
static THIRD_IN: Indices = indices(Step::ThirdIn);

type Indices = [[i32; 16]; 3];

/// Which of the four permutations: numbers out of the first two thirds, then out of the last; coordinates x and y put in, then z.
#[derive(Clone, Copy)]
enum Step {
    OutOfTwo,
    OutOfThird,
    TwoIn,
    ThirdIn,
}

const fn indices(step: Step) -> Indices {
    let mut all = [[0; 16]; 3];
    let mut place = 0;
    while place < 48 {
        let (k, i) = (place / 16, place % 16);
        // Coordinate k of triple i stands at 3 i + k, and at place 16 k + i stands this coordinate of that triple.
        let (at, coordinate, triple) = (3 * i + k, place as i32 % 3, place as i32 / 3);
        all[k][i] = match step {
            Step::OutOfTwo if at < 32 => at as i32,
            Step::OutOfThird if at >= 32 => at as i32 - 16,
            Step::TwoIn if coordinate < 2 => 16 * coordinate + triple,
            Step::ThirdIn if coordinate == 2 => 16 + triple,
            Step::OutOfTwo | Step::TwoIn => 0,
            Step::OutOfThird | Step::ThirdIn => i as i32,
        };
        place += 1;
    }
    all
}

impl Avx512 {
    /// The token, where the processor has all that the kernels are compiled for.
    pub fn detect() -> Option<Self> {
        let all = std::arch::is_x86_feature_detected!("avx512f")
            && std::arch::is_x86_feature_detected!("avx512bw")
            && std::arch::is_x86_feature_detected!("avx512dq")
            && std::arch::is_x86_feature_detected!("avx512vl");
        // Kernels that have no copy for sixteen lanes use eight.
        (all && std::arch::is_x86_feature_detected!("avx2")).then_some(Self(()))
    }

    /// Eight lanes of the same processor.
    pub fn half(self) -> super::Avx2 {
        super::Avx2(())
    }
}
