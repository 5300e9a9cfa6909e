(** The planes of the tiles, operation by operation as crates/tiles/src/frames/planes.rs computes them: set up in f64, rounded to
    f32 and evaluated in f32, with the bounds that the code computes in f64. These functions run, and give the bits of the code. *)
From Coq Require Import ZArith QArith Qabs Qround Lia Lqa.
From Rasterproof Require Import Coverage Rounding Nearest EngineValues.
Open Scope Q_scope.

(** ** Rounding to f32: 24 bits, numbers from 2^-149 on *)

Definition w : Q := Eval compute in 1 # (2 ^ 24).

Definition last_bit32 (x : Q) : Z := Z.max (exponent x - 23) (-149).

Definition nearest32_positive (x : Q) : Q := inject_Z (whole (x * pow2 (- last_bit32 x))) * pow2 (last_bit32 x).

Definition nearest32 (x : Q) : Q :=
  if Qeq_bool x 0 then 0 else if Qle_bool 0 x then nearest32_positive x else - nearest32_positive (- x).

(** Half of the smallest number of f32, 2^-150. *)
Definition tiny : Q := Eval compute in 1 # (2 ^ 150).

Lemma nearest32_positive_near x : 0 < x -> Qabs (nearest32_positive x - x) <= w * x + tiny.
Proof.
  intros Hx. unfold nearest32_positive. set (k := last_bit32 x). pose proof (pow2_positive k).
  pose proof (whole_near (x * pow2 (- k))) as H1. set (m := inject_Z (whole (x * pow2 (- k)))) in *.
  assert (E : m * pow2 k - x == (m - x * pow2 (- k)) * pow2 k).
  { setoid_replace ((m - x * pow2 (- k)) * pow2 k) with (m * pow2 k - x * (pow2 (- k) * pow2 k)) by ring.
    rewrite pow2_inverse. ring. }
  rewrite E, Qabs_Qmult, (Qabs_pos (pow2 k)) by lra.
  apply Qle_trans with ((1 # 2) * pow2 k); [apply Qmult_le_compat_r; lra|].
  assert (T : 0 <= tiny) by discriminate. assert (W : 0 <= w * x) by (unfold w; lra).
  destruct (Z_le_gt_dec (-149) (exponent x - 23)) as [L | L].
  - unfold k, last_bit32. rewrite Z.max_l by assumption. destruct (exponent_spec x Hx) as [B _].
    unfold Z.sub. rewrite pow2_add. assert (F : (1 # 2) * pow2 (- (23)) == w) by (apply Qeq_bool_iff; vm_compute; reflexivity).
    set (p := pow2 (exponent x)) in *. set (q := pow2 (- (23))) in *.
    setoid_replace ((1 # 2) * (p * q)) with (p * ((1 # 2) * q)) by ring. rewrite F. unfold w in *. lra.
  - unfold k, last_bit32. rewrite Z.max_r by lia.
    assert (F : (1 # 2) * pow2 (-149) == tiny) by (apply Qeq_bool_iff; vm_compute; reflexivity). rewrite F. lra.
Qed.

Theorem nearest32_near x : Qabs (nearest32 x - x) <= w * Qabs x + tiny.
Proof.
  assert (T : 0 <= tiny) by discriminate. unfold nearest32. destruct (Qeq_bool x 0) eqn:E.
  - apply Qeq_bool_iff in E. setoid_replace (0 - x) with 0 by (rewrite E; ring). rewrite E. change (Qabs 0) with 0. lra.
  - assert (N : ~ x == 0) by (intro H; apply Qeq_bool_iff in H; congruence). destruct (Qle_bool 0 x) eqn:S.
    + apply Qle_bool_iff in S. rewrite (Qabs_pos x) by assumption. apply nearest32_positive_near. lra.
    + assert (X : x < 0) by (destruct (Qlt_le_dec x 0) as [|H]; [assumption | apply Qle_bool_iff in H; congruence]).
      rewrite (Qabs_neg x) by lra. rewrite <- Qabs_opp.
      setoid_replace (- (- nearest32_positive (- x) - x)) with (nearest32_positive (- x) - - x) by ring.
      apply nearest32_positive_near. lra.
Qed.

(** The largest f32 that is not larger: [below] of crates/render/src/effects/geometry.rs. *)
Definition below32 (x : Q) : Q :=
  let whole_below x s := inject_Z (Qfloor (x * pow2 (- s))) * pow2 s in
  if Qeq_bool x 0 then 0 else whole_below x (last_bit32 (Qabs x)).

Notation fl := nearest.

(** ** The set-up in f64: Frame *)

(** Subpixels in pixels. *)
Definition pixels (sub : Z) : Q := fl (fl (inject_Z sub) / inject_Z 256).

Record frame := Frame {
  edge_x1 : Q; edge_y1 : Q; edge_x2 : Q; edge_y2 : Q; per_area : Q;
  to_first_x : Q; to_first_y : Q
}.

(** From three corners, and the first pixel of the box. *)
Definition frame_of (a b c : point) (x0 y0 : Z) : frame :=
  let x1 := pixels (X b - X a) in let y1 := pixels (Y b - Y a) in
  let x2 := pixels (X c - X a) in let y2 := pixels (Y c - Y a) in
  Frame x1 y1 x2 y2 (fl (1 / fl (fl (x1 * y2) - fl (x2 * y1)))) (pixels (x0 * 256 + 128 - X a)) (pixels (y0 * 256 + 128 - Y a)).

Definition slope (pa d1 d2 a b : Q) : Q := fl (fl (fl (d1 * a) - fl (d2 * b)) * pa).
Definition difference (c0 c : Q) : Q := fl (c - c0).

Section Values.
Variables (x1 y1 x2 y2 pa X0 Y0 c0 c1 c2 : Q).
Definition right : Q := slope pa (difference c0 c1) (difference c0 c2) y2 y1.
Definition down : Q := slope pa (difference c0 c2) (difference c0 c1) x1 x2.
Definition start : Q := fl (c0 + fl (fl (right * X0) + fl (down * Y0))).
End Values.

Record plane := Plane { at_start : Q; to_right : Q; to_below : Q }.

Definition plane_of (f : frame) (c0 c1 c2 : Q) : plane :=
  let '(Frame x1 y1 x2 y2 pa X0 Y0) := f in
  Plane (nearest32 (start x1 y1 x2 y2 pa X0 Y0 c0 c1 c2)) (nearest32 (right y1 y2 pa c0 c1 c2))
    (nearest32 (down x1 x2 pa c0 c1 c2)).

(** ** In f32: ValuePlane::at *)

Definition at_pixel (s r d x y : Q) : Q := nearest32 (nearest32 (s + nearest32 (d * y)) + nearest32 (r * x)).

Definition plane_at (p : plane) (x y : Q) : Q := at_pixel (at_start p) (to_right p) (to_below p) x y.

(** ** The bounds, in f64 *)

(** Frame::growth: T over M. *)
Definition growth_of (f : frame) (width height : Z) : Q :=
  let '(Frame x1 y1 x2 y2 pa X0 Y0) := f in
  let reach_x := fl (Qabs X0 + inject_Z width) in let reach_y := fl (Qabs Y0 + inject_Z height) in
  let reach := fl (fl (fl (Qabs y1 + Qabs y2) * reach_x) + fl (fl (Qabs x1 + Qabs x2) * reach_y)) in
  fl (1 + fl (fl (2 * reach) * Qabs pa)).

(** Edges shorter than this many pixels have a bound. *)
Definition is_bounded (edge_bits : positive) (f : frame) : bool :=
  let short e := negb (Qle_bool (inject_Z (2 ^ Z.pos edge_bits)) (Qabs e)) in
  short (edge_x1 f) && short (edge_y1 f) && short (edge_x2 f) && short (edge_y2 f).

Definition size_of (c0 c1 c2 growth : Q) : Q := fl (larger (larger (Qabs c0) (Qabs c1)) (Qabs c2) * growth).

(** S of the bound, of the rounded numbers. *)
Definition computed_size (s r d x y : Q) : Q := fl (fl (Qabs s + Qabs (nearest32 (r * x))) + Qabs (nearest32 (d * y))).

(** ValuePlane::error, with the constants of the code. *)
Definition computed_error (of_f32 of_f64 second underflow : positive) (S T : Q) : Q :=
  fl (fl (fl (fl (inject_Z (Z.pos of_f32) * w * S) + fl (inject_Z (Z.pos of_f64) * u * T)) * (1 + (1 # 2 ^ second))) +
      (1 # 2 ^ underflow)).

(** Bounded::value: the quotient of two planes, and its bound. *)
Definition computed_quotient (n q : Q) : Q := nearest32 (n * nearest32 (1 / q)).

Definition computed_quotient_error (of_rounding second underflow : positive) (en eq n q : Q) : Q :=
  let a := Qabs (fl (n / q)) in
  let off := fl (fl (en + fl (a * eq)) / fl (q - eq)) in
  fl (fl (fl (off + fl (inject_Z (Z.pos of_rounding) * w * a)) * (1 + (1 # 2 ^ second))) + (1 # 2 ^ underflow)).

(** Below 2^bits. *)
Definition is_below (bits : positive) (x : Q) : bool := negb (Qle_bool (inject_Z (2 ^ Z.pos bits)) x).

(** ** A pixel of a triangle in a window of width x height pixels *)

(** First pixel and sides of what the window shows of a triangle's box. *)
Definition shown (a b c : Z) (side : Z) : Z * Z :=
  let first := Z.max (Z.min (Z.min a b) c / 256) 0 in
  (first, (Z.min (Z.max (Z.max a b) c / 256 + 1) side - first)%Z).

(** 1/w over the largest. *)
Definition shares (a b c : vertex) : Q * Q * Q :=
  let most := largest_inv_w a b c in (fl (inv_w_of a / most), fl (inv_w_of b / most), fl (inv_w_of c / most)).

(** A value where the code has a bound, and the bound. *)
Definition answer := option (Q * Q).

Definition tile_values (width height : Z) (a b c : vertex) (px py : Z) : answer * answer :=
  let '(x0, across) := shown (X (position a)) (X (position b)) (X (position c)) width in
  let '(y0, below) := shown (Y (position a)) (Y (position b)) (Y (position c)) height in
  let f := frame_of (position a) (position b) (position c) x0 y0 in
  let x := inject_Z (px - x0) in let y := inject_Z (py - y0) in
  let growth := growth_of f across below in
  let with_error c0 c1 c2 :=
    let p := plane_of f c0 c1 c2 in
    let S := computed_size (at_start p) (to_right p) (to_below p) x y in
    if is_below 127 S then Some (plane_at p x y, computed_error 4 11 18 126 S (size_of c0 c1 c2 growth)) else None in
  if is_bounded 18 f then
    let nearest_corner := below32 (- larger (larger (- depth a) (- depth b)) (- depth c)) in
    let '(sa, sb, sc) := shares a b c in
    (match with_error (depth a) (depth b) (depth c) with
     | Some (z, ez) => Some (larger z nearest_corner, ez)
     | None => None
     end,
     match with_error (fl (attribute a * sa)) (fl (attribute b * sb)) (fl (attribute c * sc)), with_error sa sb sc with
     | Some (n, en), Some (q, eq) =>
       if Qle_bool q eq then None
       else if is_below 127 (Qabs (fl (n / q))) then Some (computed_quotient n q, computed_quotient_error 2 18 126 en eq n q)
       else None
     | _, _ => None
     end)
  else (None, None).
