//! A plan to a picture: does what the plan says, and decides nothing.

use std::fmt;
use std::num::NonZeroU32;

use super::Effect;
use super::assembled::Assembled;
use super::conditions::{self, Facts, shadows};
use super::parts::{Part, Whole};
use super::plan::{
    Canvas, Clear, ItemPlan, Order, PiecePlan, Pieces, Plan, Rule, Samples, SceneDigest, VERSION,
};
use super::primitive::{BadScene, Piece, Prepared};
use super::samples::OnDemand;
use super::stages::{Program, Registers, To};
use crate::pipeline::Counters;
use crate::pipeline::target::{Colour, Target};
use crate::scene::Scene;
use rasterproof_core::contract::Interpolate;
use rasterproof_core::frame::Frame;
use rasterproof_core::grid::PixelRect;

/// A frame, what it cost and why.
#[derive(Clone, Debug)]
pub struct Rendered {
    /// The pixels, resolved.
    pub picture: Frame<Colour>,
    pub counters: Counters,
    /// What was paid for, and why.
    pub plan: Plan,
}

impl Rendered {
    /// Whether no triangle covers a sample. What has one colour is drawn without fragments, so the picture is looked at, too.
    #[must_use]
    pub fn is_blank(&self) -> bool {
        let mut pixels = self.picture.rows().flat_map(|(_, row)| row);
        let first = pixels.next();
        self.counters.fragments == 0 && pixels.all(|pixel| Some(pixel) == first)
    }
}

/// Why a plan cannot be followed, in words. Nothing was drawn.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PlanError(String);

impl PlanError {
    /// The plan has the form of another version, or does not name its form.
    #[must_use]
    pub fn of_version(version: Option<u64>) -> Self {
        let planned = match version {
            Some(version) => format!("the plan has the form of version {version}"),
            None => "the plan does not name its version".to_owned(),
        };
        Self(format!("{planned}, and this program reads version {VERSION}; plan again with it"))
    }
}

impl fmt::Display for PlanError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

/// What two canvases differ in, in words.
fn differences(planned: &Canvas, there: &Canvas) -> String {
    let differ = [
        ("the size", planned.size() != there.size()),
        ("the antialiasing", planned.antialias != there.antialias),
        ("the depth format", planned.depth != there.depth),
    ];
    let names: Vec<_> =
        differ.iter().filter(|(_, differ)| *differ).map(|(name, _)| *name).collect();
    format!(
        "so that {} {}",
        names.join(" and "),
        if names.len() == 1 { "differs" } else { "differ" }
    )
}

impl std::error::Error for PlanError {}

impl From<BadScene> for PlanError {
    fn from(bad: BadScene) -> Self {
        Self(bad.to_string())
    }
}

/// Who wants to know more than the finished picture.
pub(super) enum Observer<'a> {
    None,
    /// Notes for each pixel what it paid for.
    Map(&'a mut PaidMap),
    /// Looks at the screen meanwhile.
    Viewer {
        front: &'a mut Frame<Colour>,
        look: &'a mut dyn FnMut(&Frame<Colour>),
    },
}

/// Assembles a scene for a plan, as far as the plan needs to know its pieces.
pub(super) fn fit<'a>(
    plan: &Plan,
    scene: &'a Scene,
    target: &Target,
) -> Result<Assembled<'a>, PlanError> {
    let failed = |cause: String| Err(PlanError(cause));
    if plan.version != VERSION {
        return Err(PlanError::of_version(Some(plan.version.into())));
    }
    let there = Canvas { watched: plan.canvas.watched, ..Canvas::of(target) };
    if plan.canvas != there {
        let (planned, differences) = (plan.canvas, differences(&plan.canvas, &there));
        return failed(format!(
            "the plan is for {planned}, and this is {there}, {differences}; plan again, or draw the same"
        ));
    }
    let (planned, there) = (plan.items.len(), scene.items.len());
    if planned != there {
        return failed(format!("the plan has {planned} items, and the scene {there}"));
    }
    for (item, plan) in plan.items.iter().enumerate() {
        let attributes = plan.interpolates().without(plan.carries);
        if !attributes.is_empty() {
            return failed(format!(
                "the plan contradicts itself: pieces of item {item} interpolate {attributes}, which \
                 is not in its \"carries\"; add it there, or remove it from \"interpolates\""
            ));
        }
    }
    let window = plan.drawn().window();
    if let Clear::Tiles(tiles) = &plan.frame.clear
        && let Some(tile) =
            tiles.iter().find(|tile| tile.is_empty() || tile.intersect(&window) != **tile)
    {
        let PixelRect { x0, y0, x1, y1 } = tile;
        return failed(format!(
            "the plan clears a tile from ({x0}, {y0}) to ({x1}, {y1}), which is not in the window"
        ));
    }
    let mut assembled = Assembled::new(scene, plan)?;
    let there = SceneDigest::of(scene);
    match plan.scene {
        Some(planned) if planned == there => {}
        Some(planned) => {
            return failed(format!(
                "the plan is for another scene, or for the same one seen otherwise: its scene has \
                 the digest {planned}, and this one {there}; plan again with the options of this \
                 picture"
            ));
        }
        None => {
            return failed(format!(
                "the plan does not say which scene it is for (\"scene\"), and this one has the \
                 digest {there}; plan again"
            ));
        }
    }
    let lists = |item: &ItemPlan| matches!(item.pieces, Pieces::Listed(_));
    if plan.items.iter().any(lists) || plan.frame.order == Order::FarthestFirst {
        assembled.assemble(scene);
        let plans = plans(plan, scene, &assembled)?;
        assembled.plan(plans, plan.frame.order);
    }
    Ok(assembled)
}

/// What a plan says of each piece, in the order of the items.
pub(super) fn plans(
    plan: &Plan,
    scene: &Scene,
    assembled: &Assembled<'_>,
) -> Result<Vec<PiecePlan>, PlanError> {
    let (items, pieces) = (&assembled.items, assembled.pieces());
    let mut plans = Vec::with_capacity(pieces.len());
    for &item in &assembled.order {
        let planned = &plan.items[item].pieces;
        let own = pieces.iter().filter(|(index, _)| *index == item);
        match planned {
            Pieces::AsTheyCome(rule) => {
                plans.extend(own.map(|(_, piece)| as_it_comes(rule, scene, &items[item], piece)));
            }
            Pieces::Listed(runs) => {
                let there = own.count() as u64;
                let planned =
                    runs.iter().fold(0, |sum: u64, (count, _)| sum.saturating_add(*count));
                if planned != there {
                    return Err(PlanError(format!(
                        "the plan lists {planned} pieces of item {item}, which has {there}; a rule, \
                         \"as-they-come\", fits any number"
                    )));
                }
                for (count, plan) in runs {
                    plans.extend((0..*count).map(|_| *plan));
                }
            }
        }
    }
    Ok(plans)
}

/// What a rule says of a piece by the same conditions as a planner.
#[inline]
fn as_it_comes(rule: &Rule, scene: &Scene, item: &Prepared<'_>, piece: &Piece) -> PiecePlan {
    let mut facts = Facts::of(rule, item, piece);
    shadows::search(rule, scene, item, piece, &mut facts);
    conditions::plan(rule, &facts)
}

/// Draws what was assembled for a plan.
pub(super) fn draw(
    plan: Plan,
    assembled: Assembled<'_>,
    scene: &Scene,
    engine: &impl Interpolate,
    target: &mut Target,
    observer: Observer<'_>,
) -> Rendered {
    let mut single;
    let target = if plan.frame.samples == Samples::Middle {
        single = target.single();
        &mut single
    } else {
        target
    };
    let counters = assembled.counters;
    let registers = Box::new(Registers::new());
    let on_demand = None;
    let drawing = Drawing { plan, scene, engine, target, counters, on_demand, registers, observer };
    drawing.draw_all(&assembled)
}

/// A frame being drawn.
struct Drawing<'a, 'b, E> {
    plan: Plan,
    scene: &'a Scene,
    engine: &'a E,
    target: &'a mut Target,
    counters: Counters,
    on_demand: Option<OnDemand>,
    registers: Box<Registers>,
    observer: Observer<'b>,
}

impl<E: Interpolate> Drawing<'_, '_, E> {
    fn draw_all(mut self, assembled: &Assembled<'_>) -> Rendered {
        self.begin();
        if let Some(pieces) = &assembled.pieces {
            self.draw_listed(&assembled.items, pieces, &assembled.plans);
        } else {
            self.draw_as_they_come(assembled);
        }
        self.finish()
    }

    /// Draws each piece when it is assembled.
    fn draw_as_they_come(&mut self, assembled: &Assembled<'_>) {
        let scene = self.scene;
        for &index in &assembled.order {
            let item = &assembled.items[index];
            let Pieces::AsTheyCome(rule) = self.plan.items[index].pieces else { continue };
            shadows::look_ahead(scene, item, &rule);
            let mut counters = std::mem::take(&mut self.counters);
            item.assemble(scene, &mut counters, &mut |piece, fills| {
                self.draw(item, piece, as_it_comes(&rule, scene, item, piece), fills);
            });
            self.counters += counters;
            self.look();
        }
    }

    fn draw_listed(
        &mut self,
        items: &[Prepared<'_>],
        pieces: &[(usize, Piece)],
        plans: &[PiecePlan],
    ) {
        let mut fills = Counters::default();
        for (i, ((index, piece), plan)) in pieces.iter().zip(plans).enumerate() {
            self.draw(&items[*index], piece, *plan, &mut fills);
            if pieces.get(i + 1).is_none_or(|(next, _)| next != index) {
                self.look();
            }
        }
        self.counters += fills;
    }

    /// Clears what is called for, and sets up samples on demand.
    fn begin(&mut self) {
        let Self { plan, target, counters, scene, .. } = self;
        let pixels = target.pixel_count();
        target.clear_layers();
        if matches!(plan.frame.samples, Samples::OnDemand { .. }) {
            counters.cleared += pixels;
            counters.depths_cleared += if plan.tests_depths() { pixels } else { 0 };
            self.on_demand = Some(OnDemand::new(target, scene.background, plan.frame.samples));
        } else if target.antialias().samples() > 1 {
            counters.expanded += pixels;
        }
        match &plan.frame.clear {
            Clear::Nothing => {}
            Clear::Everything => target.clear_colour(scene.background, counters),
            Clear::Tiles(tiles) => target.clear_tiles(tiles, scene.background, counters),
        }
        if plan.frame.clear_depths {
            target.clear_depth(counters);
        }
        self.look();
    }

    /// Shows a viewer what is on the screen meanwhile.
    fn look(&mut self) {
        let Observer::Viewer { front, look } = &mut self.observer else { return };
        if self.plan.frame.second_buffer {
            look(front);
        } else {
            look(&resolve(self.on_demand.as_ref(), self.target));
        }
    }

    /// Draws one piece.
    fn draw(
        &mut self,
        item: &Prepared<'_>,
        piece: &Piece,
        plan: PiecePlan,
        counters: &mut Counters,
    ) {
        if plan.is_nothing() {
            return;
        }
        counters.wide += u64::from(self.engine.word_bits(&piece.corners()) > Some(i32::BITS));
        let map = item.light_view.as_ref().filter(|_| plan.shadows).map(|view| {
            let is_drawn = view.drawn().is_some();
            let map = view.map(self.scene, self.engine);
            counters.cast += if is_drawn { 0 } else { map.fragments };
            map
        });
        let parts = self.plan.items[item.index()].parts.as_ref();
        let (bounds, planes) = (self.target.bounds(), self.target.antialias().planes());
        let mut samples = self.on_demand.as_mut();
        // Where samples are told apart on demand, pixels of a multisampled picture stay whole in large pieces.
        let checked = parts
            .filter(|parts| parts.are_checked(piece, plan) && (planes == 1 || samples.is_none()));
        if checked.is_some()
            && let Some(on_demand) = samples.take()
            && !on_demand.tell_box_apart(self.engine, piece, plan.depth, self.target, counters)
        {
            return;
        }
        let Self { engine, target, observer, registers, .. } = self;
        let mut draw = |part: &Part| {
            if part.plan.is_nothing() {
                return;
            }
            if let Observer::Map(map) = observer {
                let paid = part.plan.paid();
                let scale = target.antialias().scale() as i32;
                engine.cover(piece.corners(), part.bounds, |span| {
                    for x_px in span.x0_px..span.x1_px {
                        map.pay(x_px / scale, span.y_px / scale, paid);
                    }
                });
            }
            let Part { bounds, plan, texel } = part;
            let program = Program::new(item, piece, *plan, map, *texel, registers, counters);
            let samples = samples.as_deref_mut();
            let to = To { target, bounds: *bounds, samples, registers, counters };
            program.draw(engine, piece, to);
        };
        match checked {
            None => draw(&Part { bounds, plan, texel: None }),
            Some(parts) => {
                let whole = Whole::new(parts, item, piece, plan);
                whole.each(bounds, i32::from(planes > 1), &mut draw);
            }
        }
    }

    fn finish(self) -> Rendered {
        let Self { plan, scene, mut counters, target, on_demand, observer, .. } = self;
        target.mix_layers(scene.layers.map_or(u32::MAX, NonZeroU32::get), &mut counters);
        let picture = resolve(on_demand.as_ref(), target);
        // What is presented is a copy: the back buffer goes on to the next frame.
        let picture = if plan.frame.second_buffer {
            counters.presented += target.pixel_count();
            picture.clone()
        } else {
            picture
        };
        match observer {
            Observer::None => {}
            Observer::Map(map) => {
                if target.antialias().samples() > 1 {
                    let samples_of_fragment = target.antialias().scale().pow(2);
                    mark_samples(map, on_demand.as_ref(), samples_of_fragment);
                }
            }
            Observer::Viewer { front, look } => {
                front.clone_from(&picture);
                look(front);
            }
        }
        if let Some(on_demand) = on_demand {
            on_demand.finish(target);
        }
        Rendered { picture, counters, plan }
    }
}

/// What each pixel of a picture pays for, hidden or not.
#[derive(Clone, Debug)]
pub struct PaidMap {
    /// Effects that some fragment paid for, as bits of [`Effect`] in the order of [`Effect::ALL`].
    pub effects: Frame<u32>,
    /// Fragments: with supersampling of each sample where these are told apart, with multisampling those at the centre.
    pub fragments: Frame<u32>,
    /// The effects of pixels that these fragments paid for, added up; drawing a fragment at all is 1 more.
    pub payments: Frame<u32>,
}

impl PaidMap {
    pub(super) fn new(size: PixelRect) -> Self {
        let empty = Frame::new(size, 0);
        Self { effects: empty.clone(), fragments: empty.clone(), payments: empty }
    }

    fn pay(&mut self, x_px: i32, y_px: i32, effects: u32) {
        self.effects.span_mut(y_px, x_px, x_px + 1)[0] |= effects;
        self.fragments.span_mut(y_px, x_px, x_px + 1)[0] += 1;
        // That something is interpolated is no work of its own beside what is.
        let work = effects & !(1 << Effect::Interpolation as u32);
        self.payments.span_mut(y_px, x_px, x_px + 1)[0] += 1 + work.count_ones();
    }
}

/// The picture so far.
fn resolve(on_demand: Option<&OnDemand>, target: &Target) -> Frame<Colour> {
    on_demand.map_or_else(|| target.resolve(), |on_demand| on_demand.resolve(target))
}

/// Marks the pixels whose samples were told apart. In the others a triangle covers all samples or none, and pays once.
fn mark_samples(map: &mut PaidMap, on_demand: Option<&OnDemand>, samples_of_fragment: u32) {
    let bounds = map.effects.bounds();
    for y_px in bounds.y0..bounds.y1 {
        for x_px in bounds.x0..bounds.x1 {
            let at = |frame: &mut Frame<u32>, change: &dyn Fn(u32) -> u32| {
                let pixel = &mut frame.span_mut(y_px, x_px, x_px + 1)[0];
                *pixel = change(*pixel);
            };
            if on_demand.is_none_or(|on_demand| on_demand.was_apart(x_px, y_px)) {
                at(&mut map.effects, &|bits| bits | 1 << Effect::Samples as u32);
            } else {
                at(&mut map.fragments, &|count| count / samples_of_fragment);
                at(&mut map.payments, &|count| count / samples_of_fragment);
            }
        }
    }
}
