//! The faces of a mesh near a place.

use crate::closest::tree::{TREE_ROUNDING, Tree};
use crate::space::{Aabb, Point};

impl Tree {
    /// The faces, ascending, whose boxes meet `window`, its sides included; none where it is empty or not a number.
    ///
    /// Cost: about that of a closest point, and in proportion to the faces found.
    ///
    /// ```
    /// use trueness_geom::{closest::Tree, mesh::Mesh, space::Aabb};
    /// let at = |x: f64| [[x, 0.0, 0.0], [x + 1.0, 0.0, 0.0], [x, 1.0, 0.0]];
    /// let positions = (0..10).flat_map(|k| at(f64::from(2 * k))).collect();
    /// let tree = Tree::build(&Mesh { positions, faces: (0..10).map(|k| [3 * k, 3 * k + 1, 3 * k + 2]).collect() })?;
    /// assert_eq!(tree.in_box(&Aabb { min: [3.0, 0.0, -1.0], max: [6.5, 1.0, 1.0] }), [1, 2, 3]);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn in_box(&self, window: &Aabb) -> Vec<u32> {
        if window.is_empty() {
            return vec![];
        }
        let far = self.center.map(|c| c * self.scale).iter().fold(1.0f64, |m, x| m.max(x.abs()));
        let scaled = |p: Point, pad: f64| -> Point {
            std::array::from_fn(|k| (p[k] - self.center[k]) * self.scale + pad * TREE_ROUNDING * far)
        };
        let (low, high) = (scaled(window.min, -1.0), scaled(window.max, 1.0));
        let (mut found, mut open) = (vec![], vec![self.root]);
        while let Some(child) = open.pop() {
            if child < 0 {
                let meets = |slot: &u32| Aabb::of(&self.triangle(*slot)).meets(window);
                let slots = self.slots_of(!child as usize).filter(meets);
                found.extend(slots.map(|slot| self.face[slot as usize]));
                continue;
            }
            let node = &self.nodes[child as usize];
            let meets = |lane: &usize| {
                let [from, to] =
                    [0, 3].map(|side| [0, 1, 2].map(|k| f64::from(node.bounds[side + k][*lane])));
                // An unused child is an empty box.
                from[0] <= to[0] && (0..3).all(|k| from[k] <= high[k] && to[k] >= low[k])
            };
            open.extend((0..8).filter(meets).map(|lane| node.child[lane]));
        }
        found.sort_unstable();
        found
    }
}
