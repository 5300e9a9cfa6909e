(** The constants of the Rust code, as proof/check reads them from it (RustConstants.v), are those that are proved here,
    for the rounding of f64: crates/verify/src/comparison/tolerance.rs, crates/core/src/triangle.rs and the filters of
    crates/core/src/raster/edge_function_exact.rs and crates/core/src/raster/scanline_exact.rs, and the thresholds of
    crates/render/src/pipeline/depth.rs and the planes of crates/tiles/src/frames/planes.rs. *)
From Coq Require Import ZArith QArith Qabs.
From Rasterproof Require Import Rounding RoundedForms RoundedModel RoundedValues RoundedFilters Nearest DepthKeys
  PlaneModel Planes TilePlanes Overflow.
From Rasterproof Require RustConstants.
Open Scope Q_scope.

(** Bound::at, with D the largest difference of two values and M the largest magnitude. *)
Definition stated (factors : nat * nat) (D M : Q) : Q :=
  (1 # 2 ^ RustConstants.mantissa_bits) *
    (inject_Z (Z.of_nat (fst factors)) * D + inject_Z (Z.of_nat (snd factors)) * M) *
    (1 + (1 # 2 ^ RustConstants.second_order_bits)) + (1 # 2 ^ RustConstants.underflow_bits).

Lemma stated_is_bound d m D M : stated (d, m) D M == bound d m D M.
Proof. unfold stated, bound. cbn [fst snd]. reflexivity. Qed.

(** Every 1/w that a vertex accepts. *)
Definition accepted (w : Q) : Prop := is_float w /\ sized RustConstants.inv_w_bits w.

(** Depths and attributes that a vertex accepts are small enough for the theorems of Overflow.v. *)
Theorem accepted_values_fit v : Qabs v <= two RustConstants.value_bits -> most 500 v.
Proof.
  assert (C : RustConstants.value_bits = 500%nat) by reflexivity. exact (fun H => H).
Qed.

Section Edge.
Variables (e0 e1 e2 : Z).
Hypothesis (H0 : (0 <= e0 < 2 ^ 68)%Z) (H1 : (0 <= e1 < 2 ^ 68)%Z) (H2 : (0 <= e2 < 2 ^ 68)%Z).
Hypothesis Harea : (0 < e0 + e1 + e2)%Z.
Variables (v0 v1 v2 D M : Q).
Hypothesis (F0 : is_float v0) (F1 : is_float v1) (F2 : is_float v2).
Hypothesis (D1 : Qabs (v1 - v0) <= D) (D2 : Qabs (v2 - v0) <= D).
Hypothesis (M0 : Qabs v0 <= M) (M1 : Qabs v1 <= M) (M2 : Qabs v2 <= M).

Theorem edge_function_depths : Qabs (edge_depth nearest e0 e1 e2 v0 v1 v2 - exact_depth e0 e1 e2 v0 v1 v2) <=
  stated RustConstants.edge_function_depth D M.
Proof.
  exact (edge_depth_error nearest nearest_rounds e0 e1 e2 H0 H1 H2 Harea v0 v1 v2 D M F0 F1 F2 D1 D2 M0 M1 M2).
Qed.

Theorem edge_function_attributes w0 w1 w2 largest : accepted w0 -> accepted w1 -> accepted w2 -> accepted largest ->
  Qabs (edge_attribute nearest e0 e1 e2 w0 w1 w2 largest v0 v1 v2 - exact_attribute e0 e1 e2 w0 w1 w2 v0 v1 v2) <=
    stated RustConstants.edge_function_attribute D M.
Proof.
  intros A0 A1 A2 A3. exact (edge_attribute_error nearest nearest_rounds e0 e1 e2 H0 H1 H2 Harea
    w0 w1 w2 largest A0 A1 A2 A3 v0 v1 v2 D M F0 F1 F2 D1 D2 M0 M1 M2).
Qed.
End Edge.

Section Row.
Variables (l r : Z).
Hypothesis (Hl : (0 <= l < 2 ^ 68)%Z) (Hr : (0 < r < 2 ^ 68)%Z).
Variables (below1 above1 height1 below2 above2 height2 : Z).
Hypothesis (Hb1 : (0 <= below1)%Z) (Ha1 : (0 < above1)%Z) (Hs1 : (below1 + above1 = height1)%Z) (Hh1 : (height1 < 2 ^ 33)%Z).
Hypothesis (Hb2 : (0 <= below2)%Z) (Ha2 : (0 < above2)%Z) (Hs2 : (below2 + above2 = height2)%Z) (Hh2 : (height2 < 2 ^ 33)%Z).
Variables (va vb vc vd D M : Q).
Hypothesis Values : all_within D M (va :: vb :: vc :: vd :: nil).

Theorem scanline_depths l0 r0 : (0 <= l0 < 2 ^ 68)%Z -> (0 < r0 < 2 ^ 68)%Z ->
  (l0 * height2 + r0 * height1 = l * height2 + r * height1)%Z ->
  Qabs (scanline_depth nearest l below1 height1 below2 height2 l0 r0 va vb vc vd -
        exact_scanline_depth l r below1 height1 below2 height2 va vb vc vd) <= stated RustConstants.scanline_depth D M.
Proof.
  intros A B C. exact (scanline_depth_error nearest nearest_rounds l r Hl Hr below1 above1 height1 below2 above2 height2
    Hb1 Ha1 Hs1 Hh1 Hb2 Ha2 Hs2 Hh2 l0 r0 va vb vc vd D M A B C Values).
Qed.

Theorem scanline_attributes wa wb wc wd largest :
  accepted wa -> accepted wb -> accepted wc -> accepted wd -> accepted largest ->
  Qabs (scanline_attribute nearest l r below1 above1 height1 below2 above2 height2 wa wb wc wd largest va vb vc vd -
        exact_scanline_attribute l r below1 above1 below2 above2 wa wb wc wd va vb vc vd) <=
    stated RustConstants.scanline_attribute D M.
Proof.
  intros A B C E F. exact (scanline_attribute_error nearest nearest_rounds l r Hl Hr
    below1 above1 height1 below2 above2 height2 Hb1 Ha1 Hs1 Hh1 Hb2 Ha2 Hs2 Hh2
    wa wb wc wd largest A B C E F va vb vc vd D M Values).
Qed.
End Row.

Theorem lines i n a b D M : (0 <= i <= n)%Z -> (0 < n < 2 ^ 33)%Z -> is_float a -> is_float b ->
  Qabs (b - a) <= D -> Qabs a <= M -> Qabs b <= M ->
  Qabs (line_value nearest i n a b - (a + (b - a) * (inject_Z i / inject_Z n))) <= stated RustConstants.line_attribute D M /\
  RustConstants.line_depth = RustConstants.line_attribute.
Proof.
  intros. split; [exact (line_error nearest nearest_rounds i n a b D M H H0 H1 H2 H3 H4 H5) | reflexivity].
Qed.

(** The factors of both filters, times 2^-53. *)
Theorem edge_function_filter : inject_Z (Z.pos RustConstants.edge_filter_factor) * u == 5 * u /\
  forall ax ay bx by_ px py reach_x reach_y,
  is_float ax -> is_float ay -> is_float bx -> is_float by_ -> is_float px -> is_float py ->
  Qabs (nearest (px - ax)) <= reach_x -> Qabs (nearest (py - ay)) <= reach_y ->
  Qabs (estimate nearest ax ay bx by_ px py - ((bx - ax) * (py - ay) - (by_ - ay) * (px - ax)))
    <= edge_bound nearest ax ay bx by_ reach_x reach_y.
Proof. split; [reflexivity|]. intros. apply (edge_filter nearest nearest_rounds); assumption. Qed.

Theorem scanline_filter : inject_Z (Z.pos RustConstants.scanline_filter_factor) * u == 6 * u /\
  forall ax ay bx by_ yc,
  is_float ax -> is_float ay -> is_float bx -> is_float by_ -> is_float yc -> least_height <= by_ - ay ->
  let t := quotient nearest ax ay bx by_ yc in let x := crossing nearest ax ay bx by_ yc in
  let exact := ax + (yc - ay) * (bx - ax) / (by_ - ay) in
  lowest nearest x (crossing_bound nearest x t) <= exact - (1 # 2) <= highest nearest x (crossing_bound nearest x t).
Proof. split; [reflexivity|]. intros. apply (RoundedFilters.scanline_filter nearest nearest_rounds); assumption. Qed.

(** Near a multiple of 2^-20 every depth has one key of 24 bits. *)
Theorem depth_thresholds : RustConstants.added_tenths = 5%positive /\ forall a depth, (0 <= a <= 2 ^ 20)%Z -> 0 <= depth <= 1 ->
  Qabs (depth - inject_Z a / inject_Z (2 ^ 20)) <= 1 # 2 ^ 46 ->
  key (inject_Z (Z.pos RustConstants.moved_parts)) (Z.pos RustConstants.moved_bits)
    (2 ^ Z.pos RustConstants.unorm24_bits - 1) depth =
  key_of_fraction (2 ^ Z.pos RustConstants.unorm24_bits - 1) a.
Proof. split; [reflexivity | exact keys_of_24_bits]. Qed.

(** The bounds that the tiles compute for planes and quotients, for triangles whose edges are short enough for the code to state one.
    A depth is that of the plane or, where that is behind it, the nearest corner's ([nearest_corner_is_harmless]). *)
Notation tile_error := (computed_error RustConstants.plane_f32 RustConstants.plane_f64 RustConstants.plane_second_order_bits 126).
Notation tile_domain := (in_domain RustConstants.plane_edge_bits).

(** Compared first, since Coq takes long to find two computations different. *)
Definition tile_constants : Prop :=
  (RustConstants.plane_f32 = 4 /\ RustConstants.plane_f64 = 11 /\ RustConstants.plane_second_order_bits = 18 /\
   RustConstants.plane_edge_bits = 18 /\ RustConstants.plane_quotient = 2 /\ RustConstants.plane_sum_bits = 127 /\
   RustConstants.plane_attribute_bits = 62)%positive.

Theorem tile_planes a b c x0 y0 width height z0 z1 z2 x y : tile_domain a b c x0 y0 width height ->
  Qabs x <= inject_Z width -> Qabs y <= inject_Z height ->
  let f := frame_of a b c x0 y0 in let p := plane_of f z0 z1 z2 in
  Qabs (plane_at p x y - exact_plane a b c x0 y0 z0 z1 z2 x y) <=
    tile_error (computed_size (at_start p) (to_right p) (to_below p) x y) (size_of z0 z1 z2 (growth_of f width height)).
Proof.
  assert (C : tile_constants) by (repeat split; reflexivity).
  exact (tile_depth a b c x0 y0 width height z0 z1 z2 x y).
Qed.

Theorem tile_attributes a b c x0 y0 width height w0 w1 w2 most v0 v1 v2 x y : tile_domain a b c x0 y0 width height ->
  accepted w0 -> accepted w1 -> accepted w2 -> accepted most -> w0 <= most -> w1 <= most -> w2 <= most ->
  Qabs x <= inject_Z width -> Qabs y <= inject_Z height ->
  let f := frame_of a b c x0 y0 in let growth := growth_of f width height in
  let s0 := nearest (w0 / most) in let s1 := nearest (w1 / most) in let s2 := nearest (w2 / most) in
  let c0 := nearest (v0 * s0) in let c1 := nearest (v1 * s1) in let c2 := nearest (v2 * s2) in
  let over := plane_of f c0 c1 c2 in let under := plane_of f s0 s1 s2 in
  let error p T := tile_error (computed_size (at_start p) (to_right p) (to_below p) x y) T in
  let en := error over (size_of c0 c1 c2 growth) in let eq := error under (size_of s0 s1 s2 growth) in
  eq < plane_at under x y ->
  Qabs (computed_quotient (plane_at over x y) (plane_at under x y) -
        exact_plane a b c x0 y0 (v0 * (w0 / most)) (v1 * (w1 / most)) (v2 * (w2 / most)) x y /
        exact_plane a b c x0 y0 (w0 / most) (w1 / most) (w2 / most) x y) <=
    computed_quotient_error RustConstants.plane_quotient RustConstants.plane_second_order_bits 126
      en eq (plane_at over x y) (plane_at under x y).
Proof.
  assert (C : tile_constants) by (repeat split; reflexivity).
  exact (tile_attribute a b c x0 y0 width height w0 w1 w2 most v0 v1 v2 x y).
Qed.

(** No sum of a plane leaves f32 where the code has a bound for it, and it has one for attributes up to the one that it states. *)
Theorem tile_sums s r d x y : computed_size s r d x y < inject_Z (2 ^ Z.pos RustConstants.plane_sum_bits) ->
  Qabs s <= largest32 /\ Qabs (nearest32 (r * x)) <= largest32 /\ Qabs (nearest32 (d * y)) <= largest32 /\
  Qabs (nearest32 (s + nearest32 (d * y))) <= largest32 /\ Qabs (at_pixel s r d x y) <= largest32.
Proof.
  assert (C : tile_constants) by (repeat split; reflexivity).
  exact (tile_sums_fit s r d x y).
Qed.

Theorem tile_attributes_fit a b c x0 y0 width height w0 w1 w2 most v0 v1 v2 x y : tile_domain a b c x0 y0 width height ->
  accepted w0 -> accepted w1 -> accepted w2 -> accepted most -> w0 <= most -> w1 <= most -> w2 <= most ->
  let largest := inject_Z (2 ^ Z.pos RustConstants.plane_attribute_bits) in
  Qabs v0 <= largest -> Qabs v1 <= largest -> Qabs v2 <= largest -> Qabs x <= inject_Z width -> Qabs y <= inject_Z height ->
  let over v s := nearest (v * nearest (s / most)) in
  let p := plane_of (frame_of a b c x0 y0) (over v0 w0) (over v1 w1) (over v2 w2) in
  computed_size (at_start p) (to_right p) (to_below p) x y < inject_Z (2 ^ Z.pos RustConstants.plane_sum_bits).
Proof.
  assert (C : tile_constants) by (repeat split; reflexivity).
  exact (small_attributes_fit a b c x0 y0 width height w0 w1 w2 most v0 v1 v2 x y).
Qed.
