//! One lane: the twin that the vector types are compared with, and the only one on other processors.

use super::Simd;

/// Plain `f32`.
#[derive(Debug, Clone, Copy)]
pub struct Scalar;

/// An integer whose sums wrap.
#[derive(Debug, Clone, Copy)]
pub struct Int(i32);

impl Int {
    /// The plain integer.
    pub fn value(self) -> i32 {
        self.0
    }
}

macro_rules! int_ops {
    ($($trait:ident $name:ident $with:expr;)*) => { $(
        impl std::ops::$trait for Int {
            type Output = Self;
            #[inline(always)]
            fn $name(self, other: Self) -> Self {
                let with: fn(i32, i32) -> i32 = $with;
                Self(with(self.0, other.0))
            }
        }
    )* };
}
int_ops! {
    Add add i32::wrapping_add;
    Sub sub i32::wrapping_sub;
    BitAnd bitand |a, b| a & b;
    BitOr bitor |a, b| a | b;
}

impl Simd for Scalar {
    const N: usize = 1;
    const TILE: [usize; 2] = [1, 1];
    type F = f32;
    type I = Int;
    type M = bool;

    #[inline(always)]
    fn splat(self, x: f32) -> f32 {
        x
    }
    #[inline(always)]
    fn isplat(self, x: i32) -> Int {
        Int(x)
    }
    #[inline(always)]
    fn iota(self) -> Int {
        Int(0)
    }
    #[inline(always)]
    fn load(self, from: &[f32]) -> f32 {
        from[0]
    }
    #[inline(always)]
    fn store(self, x: f32, to: &mut [f32]) {
        to[0] = x;
    }
    #[inline(always)]
    fn iload(self, from: &[u32]) -> Int {
        Int(from[0] as i32)
    }
    #[inline(always)]
    fn istore(self, x: Int, to: &mut [u32]) {
        to[0] = x.0 as u32;
    }
    #[inline(always)]
    fn min(self, a: f32, b: f32) -> f32 {
        if a < b { a } else { b }
    }
    #[inline(always)]
    fn max(self, a: f32, b: f32) -> f32 {
        if a > b { a } else { b }
    }
    #[inline(always)]
    fn sqrt(self, x: f32) -> f32 {
        x.sqrt()
    }
    #[inline(always)]
    fn lt(self, a: f32, b: f32) -> bool {
        a < b
    }
    #[inline(always)]
    fn ilt(self, a: Int, b: Int) -> bool {
        a.0 < b.0
    }
    #[inline(always)]
    fn select(self, which: bool, yes: f32, no: f32) -> f32 {
        if which { yes } else { no }
    }
    #[inline(always)]
    fn iselect(self, which: bool, yes: Int, no: Int) -> Int {
        if which { yes } else { no }
    }
    #[inline(always)]
    fn trunc(self, x: f32) -> Int {
        // What `cvttps2dq` gives; a cast would saturate.
        Int(if x.abs() < 2_147_483_648.0 { x as i32 } else { i32::MIN })
    }
    #[inline(always)]
    fn float(self, x: Int) -> f32 {
        x.0 as f32
    }
    #[inline(always)]
    fn bits(self, x: f32) -> Int {
        Int(x.to_bits() as i32)
    }
    #[inline(always)]
    fn float_bits(self, x: Int) -> f32 {
        f32::from_bits(x.0 as u32)
    }
    #[inline(always)]
    fn shl<const BY: i32>(self, x: Int) -> Int {
        Int(x.0 << BY)
    }
    #[inline(always)]
    fn shr<const BY: i32>(self, x: Int) -> Int {
        Int((x.0 as u32 >> BY) as i32)
    }
    #[inline(always)]
    fn imul(self, a: Int, b: Int) -> Int {
        Int(a.0.wrapping_mul(b.0))
    }
    #[inline(always)]
    fn mul16(self, a: Int, b: Int) -> Int {
        let (a, b) = (a.0 as u32, b.0 as u32);
        let low = (a & 0xFFFF).wrapping_mul(b & 0xFFFF) & 0xFFFF;
        Int((low | (a >> 16).wrapping_mul(b >> 16) << 16) as i32)
    }
    #[inline(always)]
    fn dot16(self, a: Int, b: Int) -> Int {
        let product = |by: u32| i32::from((a.0 >> by) as i16).wrapping_mul(i32::from((b.0 >> by) as i16));
        Int(product(0).wrapping_add(product(16)))
    }
    #[inline(always)]
    fn gather(self, from: &[u32], index: Int) -> Int {
        Int(from[(index.0 as u32 as usize).min(from.len() - 1)] as i32)
    }
    #[inline(always)]
    fn pairs(self, from: &[u32], index: Int) -> [Int; 2] {
        let at = (index.0 as u32 as usize).min(from.len() - 2);
        [Int(from[at] as i32), Int(from[at + 1] as i32)]
    }
    #[inline(always)]
    unsafe fn tile(self, from: *const u32, _: usize) -> Int {
        // SAFETY: the caller's promise.
        Int(unsafe { from.read() } as i32)
    }
    #[inline(always)]
    unsafe fn set_tile(self, x: Int, to: *mut u32, _: usize) {
        // SAFETY: the caller's promise.
        unsafe { to.write(x.0 as u32) }
    }
    #[inline(always)]
    unsafe fn quads(self, from: *const f32, _: usize) -> [f32; 4] {
        // SAFETY: the caller's promise.
        unsafe { from.cast::<[f32; 4]>().read() }
    }
    #[inline(always)]
    fn triples(self, from: &[[f32; 3]]) -> [f32; 3] {
        from[0]
    }
    #[inline(always)]
    fn set_triples(self, x: [f32; 3], to: &mut [[f32; 3]]) {
        to[0] = x;
    }
    #[inline(always)]
    fn mask_bits(self, m: bool) -> u32 {
        u32::from(m)
    }
}
