(** What snapping does to a mesh. Corners as they are given are points of a fine grid, whose units are as small as one likes, and snapping
    is a function of a point. So both triangles at an edge snap it alike, and a corner that lies within the edge of a third triangle is
    not snapped with that edge. *)
From Coq Require Import ZArith Lia Bool List Permutation.
From Rasterproof Require Import Coverage Mesh.
Import ListNotations.
Open Scope Z_scope.

Section Snapping.

Variable snap : point -> point.

Definition snap_edge (e : point * point) := (snap (fst e), snap (snd e)).
Definition snap_triangle (t : triangle) : triangle := let '(a, b, c) := t in (snap a, snap b, snap c).

(** ** No crack without T-junctions *)

(** What a triangle of any winding adds to the winding number of a sample. *)
Definition turns (t : triangle) x y := sum (fun e => turn e x y) (edges t).

Lemma turns_outside a b c x y : inside a b c x y = false -> turns (a, b, c) x y = 0.
Proof.
  unfold turns, turn, inside, crosses; cbn.
  destruct (above a y), (above b y), (above c y);
    destruct (left_of a b x y), (left_of b a x y), (left_of b c x y),
      (left_of c b x y), (left_of c a x y), (left_of a c x y); cbn; intros; congruence || lia.
Qed.

(** Only a triangle that is not turned over winds around a sample as its mesh does, and it covers the sample then. *)
Lemma turns_covers t x y : 0 < turns t x y -> clockwise t /\ covers t x y = true.
Proof.
  destruct t as [[a b] c]. intros H. cbn.
  destruct (Z.lt_trichotomy (area2 a b c) 0) as [A | [A | A]].
  - exfalso. pose proof (inside_is_winding a c b x y ltac:(rewrite area2_flip; lia)) as W.
    pose proof (turn_flip (a, b) x y). pose proof (turn_flip (b, c) x y). pose proof (turn_flip (c, a) x y).
    unfold flip, turns in *; cbn [edges sum fst snd] in *. destruct (inside a c b x y); cbn [Z.b2z] in W; lia.
  - exfalso. rewrite turns_outside in H by (apply inside_degenerate; assumption). lia.
  - split; [assumption |]. pose proof (inside_is_winding a b c x y A) as W.
    unfold turns in H; cbn [edges sum] in H. destruct (inside a b c x y); [reflexivity | cbn [Z.b2z] in W; lia].
Qed.

Lemma some_positive {A} (f : A -> Z) l : 0 < sum f l -> exists a, In a l /\ 0 < f a.
Proof.
  induction l as [| a l IH]; cbn [sum]; [lia |]. intros H.
  destruct (Z.lt_ge_cases 0 (f a)); [exists a; split; [left; reflexivity | assumption] |].
  destruct IH as (b & I & P); [lia |]. exists b. split; [right; assumption | assumption].
Qed.

Lemma edges_of_snapped mesh : flat_map edges (map snap_triangle mesh) = map snap_edge (flat_map edges mesh).
Proof. induction mesh as [| [[a b] c] mesh IH]; cbn; [| rewrite IH]; reflexivity. Qed.

Lemma snapped_mesh mesh boundary inner :
  Permutation (flat_map edges mesh) (boundary ++ inner ++ map flip inner) ->
  Permutation (flat_map edges (map snap_triangle mesh))
    (map snap_edge boundary ++ map snap_edge inner ++ map flip (map snap_edge inner)).
Proof.
  intros P. rewrite edges_of_snapped. apply (Permutation_map snap_edge) in P.
  rewrite !map_app in P. rewrite map_map in P. rewrite map_map. exact P.
Qed.

Lemma all_turns mesh boundary inner x y :
  Permutation (flat_map edges mesh) (boundary ++ inner ++ map flip inner) ->
  sum (fun t => turns t x y) mesh = winding boundary x y.
Proof.
  intros P. transitivity (sum (fun e => turn e x y) (flat_map edges mesh)).
  - clear P. induction mesh as [| t mesh IH]; cbn [sum flat_map]; [reflexivity |].
    rewrite sum_app, IH. reflexivity.
  - unfold winding. rewrite (sum_permutation _ _ _ P), !sum_app.
    enough (sum (fun e => turn e x y) inner + sum (fun e => turn e x y) (map flip inner) = 0) by lia.
    clear P. induction inner as [| e inner IH]; cbn [sum map]; [reflexivity |]. rewrite turn_flip. lia.
Qed.

(** Without T-junctions, which is what the permutation says, snapping opens no crack: a sample around which the snapped boundary winds
    is covered by a snapped triangle, and by one that is not turned over, so that culling leaves it. *)
Theorem snapping_opens_no_crack mesh boundary inner x y :
  Permutation (flat_map edges mesh) (boundary ++ inner ++ map flip inner) ->
  0 < winding (map snap_edge boundary) x y ->
  exists t, In t mesh /\ clockwise (snap_triangle t) /\ covers (snap_triangle t) x y = true.
Proof.
  intros P W. rewrite <- (all_turns _ _ _ x y (snapped_mesh _ _ _ P)) in W.
  apply some_positive in W as (s & I & T). apply in_map_iff in I as (t & <- & I).
  exists t. split; [assumption |]. apply turns_covers; assumption.
Qed.

(** Where no triangle is turned over or flattened, there is no fold either. *)
Theorem no_fold_unless_turned mesh boundary inner x y :
  Permutation (flat_map edges mesh) (boundary ++ inner ++ map flip inner) ->
  Forall clockwise (map snap_triangle mesh) ->
  times_covered (map snap_triangle mesh) x y = winding (map snap_edge boundary) x y.
Proof. intros P C. eapply watertight; [assumption | apply snapped_mesh; eassumption]. Qed.

End Snapping.

(** ** How large a triangle must be *)

(** A corner moves by at most half a step of the grid, which has n units, in x and in y. *)
Definition moved (n : Z) (p q : point) := 2 * Z.abs (X q - X p) <= n /\ 2 * Z.abs (Y q - Y p) <= n.

Definition width (a b c : point) := max3 (X a) (X b) (X c) - min3 (X a) (X b) (X c).
Definition height (a b c : point) := max3 (Y a) (Y b) (Y c) - min3 (Y a) (Y b) (Y c).

Lemma product_bound n d e : 2 * Z.abs d <= n -> - (n * Z.abs e) <= 2 * (d * e).
Proof.
  intros H. pose proof (Z.mul_le_mono_nonneg_r _ _ (Z.abs e) (Z.abs_nonneg e) H).
  rewrite <- Z.mul_assoc, <- Z.abs_mul in *. lia.
Qed.

Lemma around p q r :
  Z.abs (q - r) + Z.abs (r - p) + Z.abs (p - q) = 2 * (max3 p q r - min3 p q r).
Proof. unfold max3, min3. lia. Qed.

Lemma range_of_moves n p q r :
  2 * Z.abs p <= n -> 2 * Z.abs q <= n -> 2 * Z.abs r <= n -> max3 p q r - min3 p q r <= n.
Proof. unfold max3, min3. lia. Qed.

Lemma abs_swap p q : Z.abs (p - q) = Z.abs (q - p).
Proof. lia. Qed.

(** In steps: where twice the area exceeds the width and the height of the triangle and 1, snapping turns it neither over nor flat. *)
Theorem large_triangles_are_not_turned n a b c a' b' c' :
  moved n a a' -> moved n b b' -> moved n c c' ->
  n * (width a b c + height a b c + n) < area2 a b c -> clockwise (a', b', c').
Proof.
  intros [Ax Ay] [Bx By] [Cx Cy] H. cbn.
  set (ax := X a' - X a) in *. set (ay := Y a' - Y a) in *. set (bx := X b' - X b) in *.
  set (by_ := Y b' - Y b) in *. set (cx := X c' - X c) in *. set (cy := Y c' - Y c) in *.
  assert (I : area2 a' b' c' = area2 a b c
    + (ax * (Y b - Y c) + bx * (Y c - Y a) + cx * (Y a - Y b))
    + (ay * (X c - X b) + by_ * (X a - X c) + cy * (X b - X a))
    + (ax * (by_ - cy) + bx * (cy - ay) + cx * (ay - by_)))
    by (subst ax ay bx by_ cx cy; unfold area2, E; ring).
  pose proof (product_bound n ax (Y b - Y c) Ax). pose proof (product_bound n bx (Y c - Y a) Bx).
  pose proof (product_bound n cx (Y a - Y b) Cx). pose proof (product_bound n ay (X c - X b) Ay).
  pose proof (product_bound n by_ (X a - X c) By). pose proof (product_bound n cy (X b - X a) Cy).
  pose proof (product_bound n ax (by_ - cy) Ax). pose proof (product_bound n bx (cy - ay) Bx).
  pose proof (product_bound n cx (ay - by_) Cx).
  pose proof (around (Y a) (Y b) (Y c)) as RY. pose proof (around (X a) (X b) (X c)) as RX.
  pose proof (around ay by_ cy) as RQ.
  pose proof (range_of_moves n ay by_ cy Ay By Cy) as Q.
  rewrite (abs_swap (X c) (X b)), (abs_swap (X a) (X c)), (abs_swap (X b) (X a)) in *.
  assert (N : 0 <= n) by (clear - Ax; lia).
  fold (height a b c) in RY. fold (width a b c) in RX.
  assert (TQ : n * (max3 ay by_ cy - min3 ay by_ cy) <= n * n) by (clear - Q N; nia).
  assert (TY : n * Z.abs (Y b - Y c) + n * Z.abs (Y c - Y a) + n * Z.abs (Y a - Y b) = 2 * (n * height a b c))
    by (rewrite <- !Z.mul_add_distr_l, RY; ring).
  assert (TX : n * Z.abs (X b - X c) + n * Z.abs (X c - X a) + n * Z.abs (X a - X b) = 2 * (n * width a b c))
    by (rewrite <- !Z.mul_add_distr_l, RX; ring).
  assert (TM : n * Z.abs (by_ - cy) + n * Z.abs (cy - ay) + n * Z.abs (ay - by_) =
               2 * (n * (max3 ay by_ cy - min3 ay by_ cy)))
    by (rewrite <- !Z.mul_add_distr_l, RQ; ring).
  rewrite !Z.mul_add_distr_l in H.
  (* What is left is linear in these products. *)
  clear RX RY RQ Q Ax Ay Bx By Cx Cy. repeat match goal with
  | K : context [n * Z.abs ?e] |- _ => generalize dependent (n * Z.abs e); intros
  end. lia.
Qed.

(** ** A fold *)

(** To the nearest multiple of n. *)
Definition to_grid n (p : point) := Pt ((2 * X p + n) / (2 * n) * n) ((2 * Y p + n) / (2 * n) * n).

(** A plane mesh of six triangles on a rectangle of 9 x 5 px, in units of 1/2^22 px, with a narrow part along a diagonal; the grid has
    1/256 px. Its corners m and n are those of tests/data/models/snapping/fold.gltf. *)
Definition px (i : Z) := 4194304 * i.
Definition corner_m := Pt 11177736 6206070.
Definition corner_n := Pt 10941732 6080926.
Definition folded : list triangle :=
  let '(o, e, r, s) := (Pt 0 0, Pt (px 9) 0, Pt (px 9) (px 5), Pt 0 (px 5)) in
  let '(m, n) := (corner_m, corner_n) in
  [(o, e, m); (e, r, m); (o, m, n); (m, r, n); (o, n, s); (n, r, s)].

(** Without a T-junction, all triangles wound alike, each sample in one of them; once snapped, the centre of pixel (4, 2) lies in three. *)
Theorem snapping_folds :
  Forall clockwise folded /\
  times_covered folded (px 4 + px 1 / 2) (px 2 + px 1 / 2) = 1 /\
  times_covered (map (snap_triangle (to_grid 16384)) folded) (px 4 + px 1 / 2) (px 2 + px 1 / 2) = 3.
Proof.
  split; [| split; vm_compute; reflexivity].
  unfold folded. repeat (apply Forall_cons; [vm_compute; reflexivity |]). apply Forall_nil.
Qed.
