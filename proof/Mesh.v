(** Watertightness, the order of the corners, whole-pixel translation, and the nudge. *)
From Coq Require Import ZArith Lia Bool List Permutation.
From Rasterproof Require Import Coverage.
Import ListNotations.
Open Scope Z_scope.

(** ** The bias is a nudge: E > 0 at (x + 1/n, y + 1/n^2) for every n that is large enough. *)

Theorem test_is_nudge a b x y : a <> b ->
  (test a b x y = true <-> exists m, 0 < m /\ forall n, m <= n ->
     0 < E a b x y * (n * n) + (X b - X a) - (Y b - Y a) * n).
Proof.
  intros Hab. rewrite test_spec.
  set (e := E a b x y). set (dx := X b - X a). set (dy := Y b - Y a).
  replace (Y b < Y a \/ Y b = Y a /\ X a < X b) with (Y b < Y a \/ Y b = Y a /\ X a < X b) by auto.
  split.
  - intros H. exists (Z.abs dx + Z.abs dy + 1). split; [lia |]. intros n Hn.
    destruct H as [H | (H & [H1 | (H1 & H2)])].
    + assert (n * n <= e * (n * n)) by nia. assert (- (Z.abs dy * n) <= - (dy * n)) by nia. nia.
    + rewrite H. assert (n <= - dy * n) by (subst dy; nia). lia.
    + rewrite H. replace dy with 0 by lia. lia.
  - intros (m & Hm & H).
    destruct (Z.lt_trichotomy e 0) as [L | [L | L]]; [exfalso | right | left; assumption].
    + pose proof (H (m + Z.abs dx + Z.abs dy) ltac:(lia)). set (n := m + Z.abs dx + Z.abs dy) in *.
      assert (e * (n * n) <= - (n * n)) by nia. assert (- (dy * n) <= Z.abs dy * n) by nia. nia.
    + split; [assumption |].
      assert (~ (dx = 0 /\ dy = 0)).
      { intros [D1 D2]. apply Hab. destruct a, b; cbn in *. f_equal; lia. }
      rewrite L in H. destruct (Z.lt_trichotomy dy 0) as [D | [D | D]].
      * left; lia.
      * right. pose proof (H m ltac:(lia)). rewrite D in *. lia.
      * exfalso. pose proof (H (m + Z.abs dx) ltac:(lia)).
        assert (m + Z.abs dx <= dy * (m + Z.abs dx)) by nia. lia.
Qed.

(** ** Watertight *)

(** Seen from its other side an edge decides the other way. *)
Theorem test_flip a b x y : a <> b -> test b a x y = negb (test a b x y).
Proof.
  intros Hab. apply eq_true_iff_eq. rewrite negb_true_iff, <- not_true_iff_false, !test_spec.
  assert (~ (X a = X b /\ Y a = Y b)) by (intros [? ?]; apply Hab; destruct a, b; cbn in *; f_equal; auto).
  assert (E b a x y = - E a b x y) by (unfold E; ring). lia.
Qed.

Lemma area_neq a b c : 0 < area2 a b c -> a <> b.
Proof. intros H ->. unfold area2, E in H. lia. Qed.

(** Two triangles on opposite sides of a shared edge never both cover a sample. *)
Theorem shared_edge_never_twice a b c d x y : 0 < area2 a b c -> 0 < area2 b a d ->
  inside a b c x y && inside b a d x y = false.
Proof.
  intros H1 H2. rewrite <- !tests_are_parity by assumption. unfold tests.
  rewrite (test_flip a b) by (eapply area_neq; eassumption).
  destruct (test a b x y); rewrite ?andb_false_r; reflexivity.
Qed.

(** What an edge adds to the winding number of a sample: +1 if it goes up left of it, -1 if down. *)
Definition turn (e : point * point) (x y : Z) : Z :=
  let '(a, b) := e in
  match above a y, above b y with
  | true, false => - Z.b2z (left_of a b x y)
  | false, true => Z.b2z (left_of b a x y)
  | _, _ => 0
  end.

Definition flip (e : point * point) := (snd e, fst e).

Lemma turn_flip e x y : turn (flip e) x y = - turn e x y.
Proof. destruct e as [a b]; unfold turn, flip; cbn. destruct (above a y), (above b y); lia. Qed.

Lemma turn_test a b x y : test a b x y = true -> 0 <= turn (a, b) x y.
Proof.
  unfold turn. destruct (above a y) eqn:Ha, (above b y) eqn:Hb; try lia.
  - rewrite test_down by assumption.
    pose proof (crosses_down a b x y Ha Hb) as C. unfold crosses in C. rewrite Ha, Hb in C.
    rewrite C. destruct (_ <=? 0); cbn; discriminate || lia.
  - destruct (left_of b a x y); cbn; lia.
Qed.

(** A clockwise triangle covers a sample as often as it winds around it. *)
Theorem inside_is_winding a b c x y : 0 < area2 a b c ->
  Z.b2z (inside a b c x y) = turn (a, b) x y + turn (b, c) x y + turn (c, a) x y.
Proof.
  intros HA. pose proof (tests_are_parity a b c x y HA) as T.
  destruct (tests a b c x y) eqn:TT.
  - apply tests_and in TT as (T1 & T2 & T3). apply turn_test in T1, T2, T3. revert T1 T2 T3 T.
    unfold turn, inside, crosses. destruct (above a y), (above b y), (above c y);
    destruct (left_of a b x y), (left_of b a x y), (left_of b c x y),
      (left_of c b x y), (left_of c a x y), (left_of a c x y); cbn; intros; congruence || lia.
  - revert T. unfold turn, inside, crosses. destruct (above a y), (above b y), (above c y);
    destruct (left_of a b x y), (left_of b a x y), (left_of b c x y),
      (left_of c b x y), (left_of c a x y), (left_of a c x y); cbn; intros; congruence || lia.
Qed.

Definition triangle := (point * point * point)%type.
Definition clockwise (t : triangle) := let '(a, b, c) := t in 0 < area2 a b c.
Definition edges (t : triangle) := let '(a, b, c) := t in [(a, b); (b, c); (c, a)].
Definition covers (t : triangle) x y := let '(a, b, c) := t in inside a b c x y.

Fixpoint sum {A} (f : A -> Z) (l : list A) : Z :=
  match l with [] => 0 | a :: l => f a + sum f l end.

Lemma sum_app {A} (f : A -> Z) l m : sum f (l ++ m) = sum f l + sum f m.
Proof. induction l as [| a l IH]; cbn; [| rewrite IH]; lia. Qed.

Lemma sum_permutation {A} (f : A -> Z) l m : Permutation l m -> sum f l = sum f m.
Proof. induction 1; cbn; lia. Qed.

Definition winding (boundary : list (point * point)) x y : Z := sum (fun e => turn e x y) boundary.
Definition times_covered (mesh : list triangle) x y : Z :=
  sum (fun t => Z.b2z (covers t x y)) mesh.

(** However a surface is cut into triangles: inner edges leave no trace. Each sample is covered as
    often as the boundary winds around it; no hole, no double hit. *)
Theorem watertight mesh boundary inner x y :
  Forall clockwise mesh ->
  Permutation (flat_map edges mesh) (boundary ++ inner ++ map flip inner) ->
  times_covered mesh x y = winding boundary x y.
Proof.
  intros HC HP. unfold times_covered, winding.
  transitivity (sum (fun e => turn e x y) (flat_map edges mesh)).
  - clear HP. induction HC as [| [[a b] c] mesh H _ IH]; cbn in *; [reflexivity |].
    rewrite inside_is_winding, IH by assumption. unfold turn. lia.
  - rewrite (sum_permutation _ _ _ HP), !sum_app.
    enough (sum (fun e => turn e x y) inner + sum (fun e => turn e x y) (map flip inner) = 0) by lia.
    clear HP. induction inner as [| e inner IH]; cbn [sum map]; [reflexivity |]. rewrite turn_flip. lia.
Qed.

(** Two ways to cut the same surface cover the same samples equally often. *)
Corollary any_triangulation mesh mesh' boundary inner inner' x y :
  Forall clockwise mesh -> Forall clockwise mesh' ->
  Permutation (flat_map edges mesh) (boundary ++ inner ++ map flip inner) ->
  Permutation (flat_map edges mesh') (boundary ++ inner' ++ map flip inner') ->
  times_covered mesh x y = times_covered mesh' x y.
Proof. intros. rewrite (watertight mesh boundary inner), (watertight mesh' boundary inner'); auto. Qed.

(** A sample strictly inside two triangles with a shared edge, the edge between its ends included,
    is covered exactly once. *)
Theorem shared_edge_once a b c d x y : 0 < area2 a b c -> 0 < area2 b a d ->
  (0 < E b c x y /\ 0 < E c a x y /\ 0 <= E a b x y) \/
  (0 < E a d x y /\ 0 < E d b x y /\ 0 <= E b a x y) ->
  Z.b2z (inside a b c x y) + Z.b2z (inside b a d x y) = 1.
Proof.
  intros H1 H2 H. rewrite <- !tests_are_parity by assumption. unfold tests.
  rewrite (test_flip a b) by (eapply area_neq; eassumption).
  assert (F : E b a x y = - E a b x y) by (unfold E; ring).
  (* On the line of the shared edge the weights of both triangles are proportional. *)
  assert (P : area2 b a d * E b c x y - area2 a b c * E d b x y =
              - E a b x y * (E b c (X d) (Y d))) by (unfold area2, E; ring).
  assert (Q : area2 b a d * E c a x y - area2 a b c * E a d x y =
              - E a b x y * (E c a (X d) (Y d))) by (unfold area2, E; ring).
  assert (Pos : forall p q, 0 < E p q x y -> test p q x y = true) by (intros; apply test_spec; auto).
  assert (R : forall u v s t, 0 < s -> 0 < t -> s * u = t * v -> (0 < u <-> 0 < v))
    by (intros; split; nia).
  destruct (Z.lt_trichotomy (E a b x y) 0) as [L | [L | L]].
  - assert (test a b x y = false) as ->.
    { apply not_true_iff_false. rewrite test_spec. lia. }
    rewrite (Pos a d), (Pos d b) by lia. rewrite !andb_false_r. reflexivity.
  - assert (0 < E b c x y /\ 0 < E c a x y /\ 0 < E a d x y /\ 0 < E d b x y) as (? & ? & ? & ?)
      by (rewrite L in P, Q; pose proof (R (E b c x y) (E d b x y) _ _ H2 H1 ltac:(lia));
          pose proof (R (E c a x y) (E a d x y) _ _ H2 H1 ltac:(lia)); lia).
    rewrite (Pos b c), (Pos c a), (Pos a d), (Pos d b) by assumption. destruct (test a b x y); reflexivity.
  - rewrite (Pos a b), (Pos b c), (Pos c a) by lia. rewrite !andb_false_r. reflexivity.
Qed.

(** ** Order of the corners, and translation by whole pixels *)

Theorem vertex_order a b c x y :
  inside b c a x y = inside a b c x y /\ inside a c b x y = inside a b c x y.
Proof. split; [apply inside_cycle | apply inside_flip]. Qed.

Definition move (p : point) (dx dy : Z) : point := Pt (X p + dx) (Y p + dy).

Theorem translation a b c x y dx dy :
  inside (move a dx dy) (move b dx dy) (move c dx dy) (x + dx) (y + dy) = inside a b c x y.
Proof.
  assert (T : forall p q, crosses (move p dx dy) (move q dx dy) (x + dx) (y + dy) = crosses p q x y).
  { intros p q. unfold crosses.
    assert (A : forall r, above (move r dx dy) (y + dy) = above r y)
      by (intros; unfold above, move; cbn; apply eq_true_iff_eq; rewrite !Z.leb_le; lia).
    assert (L : forall r s, left_of (move r dx dy) (move s dx dy) (x + dx) (y + dy) = left_of r s x y).
    { intros r s. unfold left_of, move; cbn [X Y]. f_equal; ring. }
    rewrite !A, !L. reflexivity. }
  unfold inside. rewrite !T. reflexivity.
Qed.

(** ** Quads: whichever diagonal cuts it, the same samples, none twice *)

Theorem quad_either_diagonal a b c d x y :
  0 < area2 a b c -> 0 < area2 a c d -> 0 < area2 a b d -> 0 < area2 b c d ->
  times_covered [(a, b, c); (a, c, d)] x y = times_covered [(a, b, d); (b, c, d)] x y /\
  0 <= times_covered [(a, b, c); (a, c, d)] x y <= 1.
Proof.
  intros H1 H2 H3 H4. unfold times_covered; cbn [sum covers]. split.
  - rewrite !inside_is_winding by assumption.
    pose proof (turn_flip (c, a) x y). pose proof (turn_flip (d, b) x y).
    unfold flip in *; cbn [fst snd] in *. lia.
  - pose proof (shared_edge_never_twice c a b d x y) as N.
    rewrite (area2_cycle b c a), (area2_cycle a b c), (inside_cycle b c a), (inside_cycle a b c) in N.
    specialize (N H1 H2). destruct (inside a b c x y), (inside a c d x y); cbn in *; try discriminate; lia.
Qed.
