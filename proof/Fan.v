(** Fans: a closed fan that goes round its hub once hits each sample at most once, and
    exactly where its outline winds around it. *)
From Coq Require Import ZArith Lia Bool List Permutation.
From Rasterproof Require Import Coverage Mesh.
Import ListNotations.
Open Scope Z_scope.

Definition fan (o : point) (rim : list (point * point)) : list triangle :=
  map (fun '(a, b) => (o, a, b)) rim.

(** Every corner of the rim is left as often as it is reached. *)
Definition closed (rim : list (point * point)) : Prop := Permutation (map fst rim) (map snd rim).

Lemma closed_telescopes rim (f : point -> Z) : closed rim ->
  sum (fun e => f (snd e) - f (fst e)) rim = 0.
Proof.
  intros C. apply (sum_permutation f) in C.
  enough (sum (fun e => f (snd e) - f (fst e)) rim = sum f (map snd rim) - sum f (map fst rim)) by lia.
  clear C. induction rim as [| e rim IH]; cbn [sum map]; lia.
Qed.

(** Spokes leave no trace: the hits are the winding number of the rim. *)
Theorem fan_is_winding o rim x y : closed rim -> Forall clockwise (fan o rim) ->
  times_covered (fan o rim) x y = winding rim x y.
Proof.
  intros C H. pose proof (closed_telescopes rim (fun p => turn (p, o) x y) C) as T.
  enough (times_covered (fan o rim) x y =
    winding rim x y + sum (fun e => turn (snd e, o) x y - turn (fst e, o) x y) rim) by lia.
  clear C T. unfold times_covered, winding. induction rim as [| [a b] rim IH]; [reflexivity |].
  cbn [fan map sum] in *. inversion_clear H as [| ? ? H1 H2]. unfold fan in IH. rewrite (IH H2).
  cbn [covers fst snd]. rewrite inside_is_winding by exact H1.
  assert (turn (o, a) x y = - turn (a, o) x y) by exact (turn_flip (a, o) x y). lia.
Qed.

(** Whether the nudged sample lies clockwise of a spoke, and whether a spoke points up. *)
Definition ahead (o : point) (x y : Z) (p : point) : bool := test o p x y.
Definition up (o p : point) : bool := above p (Y o).

Definition falls (f : point -> bool) (e : point * point) : Z := Z.b2z (f (fst e) && negb (f (snd e))).

Definition between o x y (p : point) : Z :=
  if Y o <=? y then Z.b2z (negb (up o p) && ahead o x y p) else - Z.b2z (up o p && negb (ahead o x y p)).

(** A step of less than half a turn passes the sample's direction and the horizontal equally often,
    up to whether it ends or begins between the two. *)
Lemma step_passes_both o a b x y : 0 < area2 o a b ->
  falls (up o) (a, b) - falls (ahead o x y) (a, b) = between o x y b - between o x y a.
Proof.
  intros K. unfold falls, between, up, ahead, above; cbn [fst snd].
  pose proof (test_spec o a x y) as Ta. pose proof (test_spec o b x y) as Tb.
  assert (P : area2 o a b * (y - Y o) = E o a x y * (Y b - Y o) - E o b x y * (Y a - Y o))
    by (unfold area2, E; ring).
  assert (Ea : E o a x y = (X a - X o) * (y - Y o) - (Y a - Y o) * (x - X o)) by reflexivity.
  assert (Eb : E o b x y = (X b - X o) * (y - Y o) - (Y b - Y o) * (x - X o)) by reflexivity.
  assert (Ek : area2 o a b = (X a - X o) * (Y b - Y o) - (Y a - Y o) * (X b - X o)) by reflexivity.
  revert Ta Tb P Ea Eb Ek K.
  generalize (E o a x y) (E o b x y) (area2 o a b). intros ea eb k.
  set (ux := X a - X o). set (uy := Y a - Y o). set (vx := X b - X o). set (vy := Y b - Y o).
  set (dx := x - X o). set (dy := y - Y o).
  replace (Y a <=? Y o) with (uy <=? 0) by (apply eq_true_iff_eq; rewrite !Z.leb_le; lia).
  replace (Y b <=? Y o) with (vy <=? 0) by (apply eq_true_iff_eq; rewrite !Z.leb_le; lia).
  replace (Y o <=? y) with (0 <=? dy) by (apply eq_true_iff_eq; rewrite !Z.leb_le; lia).
  intros Ta Tb P Ea Eb Ek K.
  assert (Ta' : test o a x y = true <-> 0 < ea \/ ea = 0 /\ (uy < 0 \/ uy = 0 /\ 0 < ux))
    by (rewrite Ta; unfold ux, uy; clear; lia).
  assert (Tb' : test o b x y = true <-> 0 < eb \/ eb = 0 /\ (vy < 0 \/ vy = 0 /\ 0 < vx))
    by (rewrite Tb; unfold vx, vy; clear; lia).
  clear Ta Tb. clearbody ux uy vx vy dx dy.
  destruct (test o a x y); [pose proof (proj1 Ta' eq_refl) as A |
    assert (A : ~ (0 < ea \/ ea = 0 /\ (uy < 0 \/ uy = 0 /\ 0 < ux))) by (rewrite <- Ta'; discriminate)];
  (destruct (test o b x y); [pose proof (proj1 Tb' eq_refl) as B |
    assert (B : ~ (0 < eb \/ eb = 0 /\ (vy < 0 \/ vy = 0 /\ 0 < vx))) by (rewrite <- Tb'; discriminate)]);
  clear Ta' Tb';
  destruct (Z.leb_spec uy 0), (Z.leb_spec vy 0), (Z.leb_spec 0 dy); cbn [negb andb Z.b2z Z.sub Z.add Z.opp];
  try reflexivity; exfalso.
  all: assert (KD : dy <= 0 \/ 0 < k * dy) by nia; assert (KN : 0 <= dy \/ k * dy < 0) by nia.
  all: try (assert (0 <= ea * vy) by nia; assert (0 <= - eb * uy) by nia; lia).
  all: assert (F : ea * vy <= 0) by nia; assert (G : - eb * uy <= 0) by nia.
  all: assert (dy = 0) as -> by lia; rewrite Z.mul_0_r in *.
  all: assert (F0 : ea * vy = 0) by lia; assert (G0 : eb * uy = 0) by lia.
  all: clear P KD KN F G; apply Z.mul_eq_0 in F0; apply Z.mul_eq_0 in G0.
  (* The sample lies at the hub's height, and a spoke does too. *)
  all: destruct (Z.eq_dec uy 0) as [U0 | U0]; [rewrite U0, ?Z.mul_0_l in *; nia |].
  all: destruct (Z.eq_dec vy 0) as [V0 | V0]; [rewrite V0, ?Z.mul_0_l, ?Z.mul_0_r in *; nia |].
  all: assert (ea = 0) by lia; assert (eb = 0) by lia; lia.
Qed.

Lemma sum_sub {A} (f g : A -> Z) l : sum (fun a => f a - g a) l = sum f l - sum g l.
Proof. induction l as [| a l IH]; cbn [sum]; lia. Qed.

Lemma sum_le {A} (f g : A -> Z) l : (forall a, In a l -> f a <= g a) -> sum f l <= sum g l.
Proof.
  induction l as [| a l IH]; cbn [sum]; intros H; [lia |].
  pose proof (H a (or_introl eq_refl)). specialize (IH (fun b Hb => H b (or_intror Hb))). lia.
Qed.

Lemma sum_ext {A} (f g : A -> Z) l : (forall a, In a l -> f a = g a) -> sum f l = sum g l.
Proof. intros H. apply Z.le_antisymm; apply sum_le; intros a Ha; rewrite (H a Ha); lia. Qed.

(** A closed fan whose rim winds once around its hub covers no sample twice. *)
Theorem fan_never_twice o rim x y : closed rim -> Forall clockwise (fan o rim) ->
  winding rim (X o) (Y o) = 1 ->
  0 <= times_covered (fan o rim) x y <= 1.
Proof.
  intros C H W.
  assert (Cl : forall e, In e rim -> 0 < area2 o (fst e) (snd e)).
  { intros [a b] He. rewrite Forall_forall in H. apply (H (o, a, b)).
    apply (in_map (fun '(a, b) => (o, a, b)) rim (a, b)) in He. exact He. }
  (* Once around is one fall of "up"; the same number of falls for every half-plane. *)
  assert (U : sum (falls (up o)) rim = 1).
  { rewrite <- W. unfold winding.
    rewrite (sum_ext (fun e => turn e (X o) (Y o))
      (fun e => falls (up o) e - (Z.b2z (up o (fst e)) - Z.b2z (up o (snd e))))).
    - rewrite sum_sub. pose proof (closed_telescopes rim (fun p => Z.b2z (up o p)) C).
      rewrite sum_sub in *. lia.
    - intros [a b] He. apply Cl in He. cbn [fst snd] in *. unfold falls, turn, up, left_of; cbn [fst snd].
      unfold area2, E in He.
      destruct (above a (Y o)), (above b (Y o)); cbn [negb andb Z.b2z]; try reflexivity;
        match goal with |- context [?p <=? ?q] => destruct (Z.leb_spec p q) end; cbn [Z.b2z]; lia. }
  assert (A : sum (falls (ahead o x y)) rim = 1).
  { pose proof (closed_telescopes rim (between o x y) C) as T.
    rewrite (sum_ext _ (fun e => falls (up o) e - falls (ahead o x y) e)) in T.
    - rewrite sum_sub in T. lia.
    - intros [a b] He. apply Cl in He. cbn [fst snd] in *. symmetry. apply step_passes_both. exact He. }
  split.
  - unfold times_covered. clear. induction (fan o rim) as [| t l IH]; cbn [sum]; [lia |].
    destruct (covers t x y); cbn [Z.b2z]; lia.
  - rewrite <- A. unfold times_covered, fan. clear - Cl.
    induction rim as [| [a b] rim IH]; cbn [sum map]; [lia |].
    assert (Z.b2z (covers (o, a, b) x y) <= falls (ahead o x y) (a, b)).
    { pose proof (Cl (a, b) (or_introl eq_refl)) as K. cbn [fst snd] in K.
      unfold covers, falls, ahead; cbn [fst snd]. rewrite <- tests_are_parity by exact K.
      rewrite <- (test_flip o b).
      - unfold tests. destruct (test a b x y), (test b o x y), (test o a x y); cbn; lia.
      - intros ->. unfold area2, E in K. lia. }
    specialize (IH (fun e He => Cl e (or_intror He))). lia.
Qed.

(** ** Exactly once inside the rim *)

(** The oracle's question, asked of the whole rim: an odd number of crossings to the left. *)
Definition inside_rim (rim : list (point * point)) x y : bool :=
  fold_right (fun e odd => xorb (crosses (fst e) (snd e) x y) odd) false rim.

Lemma winding_is_odd rim x y : Z.odd (winding rim x y) = inside_rim rim x y.
Proof.
  unfold winding, inside_rim. induction rim as [| [a b] rim IH]; [reflexivity |].
  cbn [sum fold_right fst snd]. rewrite Z.odd_add, IH. f_equal.
  unfold turn, crosses. destruct (above a y), (above b y); try reflexivity;
    match goal with |- context [left_of ?p ?q x y] => destruct (left_of p q x y) end; reflexivity.
Qed.

(** Every sample inside the rim is covered exactly once, and none outside: no holes, no double hits. *)
Theorem fan_once_inside o rim x y : closed rim -> Forall clockwise (fan o rim) ->
  winding rim (X o) (Y o) = 1 ->
  times_covered (fan o rim) x y = Z.b2z (inside_rim rim x y).
Proof.
  intros C H W. pose proof (fan_never_twice o rim x y C H W) as R.
  rewrite <- winding_is_odd, <- (fan_is_winding o rim x y C H).
  assert (times_covered (fan o rim) x y = 0 \/ times_covered (fan o rim) x y = 1) as [-> | ->] by lia;
    reflexivity.
Qed.
