(** The values of one pixel as both engines compute them, operation by operation
    (crates/core/src/raster/edge_function/values.rs, crates/core/src/raster/scanline/values.rs), and of one pixel of
    a line. With [nearest] for [fl] these functions run, and give the bits of the engines. *)
From Coq Require Import ZArith QArith Qabs Lia Lqa Bool List.
From Rasterproof Require Import Coverage Grid Scanline RoundedModel Nearest.
Import ListNotations.
Open Scope Q_scope.

(** A corner with its depth, its 1/w and one attribute. *)
Record vertex := Vertex { position : point; depth : Q; inv_w_of : Q; attribute : Q }.

Section Engines.
Variable fl : Q -> Q.

(** ** The edge-function engine *)

(** The topmost, then leftmost first. *)
Definition rotated (a b c : vertex) : vertex * vertex * vertex :=
  let up p q := before (position p) (position q) in
  if up b a then (if up c b then (c, a, b) else (b, c, a)) else (if up c a then (c, a, b) else (a, b, c)).

(** Then clockwise. *)
Definition canonical (a b c : vertex) : vertex * vertex * vertex :=
  let '(p, q, r) := rotated a b c in
  if (area2 (position p) (position q) (position r) <? 0)%Z then (p, r, q) else (p, q, r).

Definition larger (a b : Q) : Q := if Qle_bool a b then b else a.

Definition largest_inv_w (a b c : vertex) : Q := larger (larger (inv_w_of a) (inv_w_of b)) (inv_w_of c).

(** The edge function of the edge opposite each corner, at the centre of a pixel. *)
Definition weights (p q r : vertex) (px py : Z) : Z * Z * Z :=
  let x := centre 128 px in let y := centre 128 py in
  (E (position q) (position r) x y, E (position r) (position p) x y, E (position p) (position q) x y).

Definition edge_function_values (a b c : vertex) (px py : Z) : Q * Q :=
  let '(p, q, r) := canonical a b c in
  let '(e0, e1, e2) := weights p q r px py in
  (edge_depth fl e0 e1 e2 (depth p) (depth q) (depth r),
   edge_attribute fl e0 e1 e2 (inv_w_of p) (inv_w_of q) (inv_w_of r) (largest_inv_w p q r)
     (attribute p) (attribute q) (attribute r)).

(** ** The scanline engine *)

(** How far a centre lies right of an edge, times its height. *)
Definition distance (a b : point) (px py : Z) : Z :=
  (centre 128 px - X a) * (Y b - Y a) - (centre 128 py - Y a) * (X b - X a).

Definition sorted (a b c : vertex) : vertex * vertex * vertex :=
  let sort p q := if before (position q) (position p) then (q, p) else (p, q) in
  let '(a, b) := sort a b in let '(b, c) := sort b c in let '(a, b) := sort a b in (a, b, c).

(** Whether f64 steps distances exactly. *)
Definition is_exact (a b c : point) : bool :=
  let extent a b c := (Z.max (Z.max a b) c - Z.min (Z.min a b) c + 256)%Z in
  (extent (X a) (X b) (X c) * extent (Y a) (Y b) (Y c) <=? 2 ^ 53)%Z.

Definition scanline_values (a b c : vertex) (px py : Z) : Q * Q :=
  let '(top, middle, bottom) := sorted a b c in
  let largest := largest_inv_w top middle bottom in
  let '(s, t) := if (py <? first_centre 128 (Y (position middle)))%Z then (top, middle) else (middle, bottom) in
  let at_row p q := column (EdgeWalk_new 128 (position p) (position q) py) in
  let '(la, lb, ra, rb) :=
    if (at_row top bottom <=? at_row s t)%Z then (top, bottom, s, t) else (s, t, top, bottom) in
  let first := Z.min (at_row top bottom) (at_row s t) in
  let origin := if is_exact (position top) (position middle) (position bottom) then first else px in
  let y := centre 128 py in
  let l px := distance (position la) (position lb) px py in
  let r px := (- distance (position ra) (position rb) px py)%Z in
  let below p := (y - Y (position p))%Z in
  let above q := (Y (position q) - y)%Z in
  let height p q := (Y (position q) - Y (position p))%Z in
  (scanline_depth fl (l px) (below la) (height la lb) (below ra) (height ra rb) (l origin) (r origin)
     (depth la) (depth lb) (depth ra) (depth rb),
   scanline_attribute fl (l px) (r px) (below la) (above lb) (height la lb) (below ra) (above rb) (height ra rb)
     (inv_w_of la) (inv_w_of lb) (inv_w_of ra) (inv_w_of rb) largest
     (attribute la) (attribute lb) (attribute ra) (attribute rb)).

(** 1/w as a vertex gets it. *)
Definition inverse (w : Q) : Q := fl (1 / w).
End Engines.

Definition rounded_edge_function := edge_function_values nearest.
Definition rounded_scanline := scanline_values nearest.
Definition rounded_inverse := inverse nearest.

(** ** What the scanline's mean of four is: the mean of three by their edge functions *)

Section Barycentric.
Open Scope Z_scope.
Variables (a b d : point) (px py : Z).
Notation y := (centre 128 py).

(** Both edges leave the upper corner a: left to b, right to d. The weights are (y - ay) times the edge functions. *)
Theorem weights_below_a_corner :
  let l := distance a b px py in let r := - distance a d px py in
  r * (Y b - y) + l * (Y d - y) = (y - Y a) * E d b (centre 128 px) y /\
  r * (y - Y a) = (y - Y a) * E a d (centre 128 px) y /\ l * (y - Y a) = (y - Y a) * E b a (centre 128 px) y.
Proof. unfold distance, E. cbv zeta. repeat split; ring. Qed.

(** Both edges end in the lower corner d: left from a, right from b. *)
Theorem weights_above_a_corner :
  let l := distance a d px py in let r := - distance b d px py in
  r * (y - Y a) + l * (y - Y b) = (Y d - y) * E a b (centre 128 px) y /\
  r * (Y d - y) = (Y d - y) * E b d (centre 128 px) y /\ l * (Y d - y) = (Y d - y) * E d a (centre 128 px) y.
Proof. unfold distance, E. cbv zeta. repeat split; ring. Qed.
End Barycentric.
