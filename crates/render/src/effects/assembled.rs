//! A scene on its way from plan to picture: in clip space, and in pieces where they are looked at.

use std::sync::Arc;

use super::conditions::blending;
use super::plan::{Attributes, ItemPlan, Order, PiecePlan, Plan};
use super::primitive::{BadScene, Piece, Prepared};
use crate::pipeline::Counters;
use crate::pipeline::shadow::LightView;
use crate::scene::Scene;
use rasterproof_core::arrays::MapArray as _;

/// A scene after the vertex stage, and after assembly where all pieces are looked at.
pub(super) struct Assembled<'a> {
    pub items: Vec<Prepared<'a>>,
    /// The numbers of the items in the order of drawing.
    pub order: Vec<usize>,
    /// With the items they are of.
    pub pieces: Option<Vec<(usize, Piece)>>,
    /// The plan of each piece, in the same order.
    pub plans: Vec<PiecePlan>,
    pub counters: Counters,
}

impl<'a> Assembled<'a> {
    /// Brings a scene into clip space, by a plan of its items.
    pub fn new(scene: &'a Scene, plan: &Plan) -> Result<Self, BadScene> {
        let mut counters = Counters::default();
        let window = plan.drawn().window();
        let reads_map = |item: &ItemPlan| item.carries.has(Attributes::PLACE);
        let light_view = plan.items.iter().any(reads_map).then(|| LightView::new(scene)).flatten();
        let light_view = light_view.map(Arc::new);
        let items = plan.items.iter().enumerate();
        let items = items
            .map(|(i, item)| {
                let light_view = light_view.clone().filter(|_| reads_map(item));
                let mut item = Prepared::new(scene, i, item, window, &mut counters)?;
                item.light_view = light_view;
                Ok(item)
            })
            .collect::<Result<Vec<Prepared<'_>>, _>>()?;
        let order = drawing_order(scene);
        Ok(Self { items, order, pieces: None, plans: Vec::new(), counters })
    }

    /// Brings all pieces into the window.
    pub fn assemble(&mut self, scene: &Scene) {
        let mut pieces = Vec::with_capacity(scene.triangles());
        for &index in &self.order {
            let item = &self.items[index];
            // Clipping makes a few more pieces than there are triangles. A list of millions must not double for them.
            let mut keep = |piece: &Piece, _: &mut Counters| {
                if pieces.len() == pieces.capacity() {
                    pieces.reserve_exact(pieces.len() / 8 + 1024);
                }
                pieces.push((index, *piece));
            };
            item.assemble(scene, &mut self.counters, &mut keep);
        }
        self.pieces = Some(pieces);
    }

    /// The pieces where they are looked at, else none.
    pub fn pieces(&self) -> &[(usize, Piece)] {
        self.pieces.as_deref().unwrap_or_default()
    }

    /// Keeps the plans of the pieces, and puts both into an order; equal distances keep the order of submission.
    pub fn plan(&mut self, plans: Vec<PiecePlan>, order: Order) {
        self.plans = plans;
        let (Order::FarthestFirst, Some(pieces)) = (order, &mut self.pieces) else { return };
        let distance = |piece: &Piece| piece.vertices.map_array(|v| v.depth).iter().sum::<f64>();
        let mut sorted: Vec<_> = pieces.iter().copied().zip(self.plans.iter().copied()).collect();
        sorted.sort_by(|((_, a), _), ((_, b), _)| distance(b).total_cmp(&distance(a)));
        (*pieces, self.plans) = sorted.into_iter().unzip();
    }
}

/// Items that blend after all others, from the farthest to the nearest by the middle of their bounding box; equal
/// distances keep the order of submission.
fn drawing_order(scene: &Scene) -> Vec<usize> {
    let (mut order, mut blended) = (Vec::with_capacity(scene.items.len()), Vec::new());
    for (index, item) in scene.items.iter().enumerate() {
        if blending::is_blended(item) {
            let (min, max) = item.mesh.bounds().unwrap_or_default();
            let middle = (scene.view * item.model).transform_point3((min + max) / 2.0);
            blended.push((middle.z, index));
        } else {
            order.push(index);
        }
    }
    blended.sort_by(|(a, _), (b, _)| b.total_cmp(a));
    order.extend(blended.into_iter().map(|(_, index)| index));
    order
}
