//! The vertices of a picture in flat arrays, and the stage that fills them.

use std::sync::Mutex;

use super::RenderError;
use super::draw_data::{DrawCall, geometry};
use super::draw_list::DrawList;
use super::light::Lights;
use super::memory::grow;
use super::pool::{Pool, take};
use super::projection::{ScreenVertex, ViewTransform};
use super::vertex::{CHUNK, Quad, VertexBuffers, vertices};
use sinew_scene::Frame;
use sinew_simd::SimdLevel;

/// What the vertex stage made of each vertex. Never shrunk: a smaller frame uses the front of the arrays.
#[derive(Debug, Default)]
pub(super) struct VertexArrays {
    pub screen: Vec<ScreenVertex>,
    pub front: Vec<Quad>,
    pub back: Vec<Quad>,
}

/// Cuts the vertex arrays into chunks.
struct Chunks<'a> {
    items: std::slice::Iter<'a, DrawCall>,
    now: Option<&'a DrawCall>,
    start: usize,
    screen: &'a mut [ScreenVertex],
    front: &'a mut [Quad],
    back: &'a mut [Quad],
}

impl<'a> Iterator for Chunks<'a> {
    type Item = (&'a DrawCall, usize, VertexBuffers<'a>);

    fn next(&mut self) -> Option<Self::Item> {
        loop {
            let Some(item) = self.now else {
                self.now = Some(self.items.next()?);
                self.start = 0;
                continue;
            };
            let n = (item.vertices.len() - self.start).min(CHUNK);
            if n == 0 {
                self.now = None;
                continue;
            }
            let start = self.start;
            self.start += n;
            let out = VertexBuffers {
                screen: self.screen.split_off_mut(..n)?,
                front: self.front.split_off_mut(..n)?,
                back: self.back.split_off_mut(..n)?,
            };
            return Some((item, start, out));
        }
    }
}

impl VertexArrays {
    /// Transforms and lights the vertices of all draw calls.
    pub(super) fn fill(
        &mut self,
        (pool, level): (&Pool, SimdLevel),
        list: &DrawList,
        frame: &Frame,
        view: &ViewTransform,
        lights: &Lights,
    ) -> Result<(), RenderError> {
        let total = list.draw_calls.last().map_or(0, |item| item.vertices.end);
        grow(&mut self.screen, total)?;
        grow(&mut self.front, total)?;
        grow(&mut self.back, total)?;
        let chunks = Mutex::new(Chunks {
            items: list.draw_calls.iter(),
            now: None,
            start: 0,
            screen: &mut self.screen,
            front: &mut self.front,
            back: &mut self.back,
        });
        pool.run(&|_| {
            while let Some((item, start, out)) = take(&chunks) {
                vertices(level, view, lights, &item.material, &geometry(frame, &list.bones, &list.computed_colors, item), start, out);
            }
        });
        for item in list.draw_calls.iter().filter(|item| item.material.depth_offset > 0.0) {
            let [factor, summand] = view.depth_bias(-item.material.depth_offset);
            self.screen.get_mut(item.vertices.clone()).into_iter().flatten().for_each(|corner| corner.q = corner.q * factor + summand);
        }
        Ok(())
    }
}
