(** What it means for a sample to belong to a triangle, as crates/oracle/src/coverage.rs says and as
    crates/core/src/raster/edge_function.rs says, and that the two are one. *)
From Coq Require Import ZArith Lia Bool.
Open Scope Z_scope.

(** A position in subpixels, y down. *)
Record point := Pt { X : Z; Y : Z }.

(** ** The specification: parity of crossings to the left of the nudged sample (crates/oracle/src). *)

(** An end point lies above the nudged sample (x + eps, y + eps^2). *)
Definition above (p : point) (y : Z) : bool := Y p <=? y.

(** The edge from u down to l crosses the height y at or left of x. *)
Definition left_of (u l : point) (x y : Z) : bool :=
  (y - Y u) * (X l - X u) <=? (x - X u) * (Y l - Y u).

Definition crosses (a b : point) (x y : Z) : bool :=
  match above a y, above b y with
  | true, false => left_of a b x y
  | false, true => left_of b a x y
  | _, _ => false
  end.

Definition inside (a b c : point) (x y : Z) : bool :=
  xorb (crosses a b x y) (xorb (crosses b c x y) (crosses c a x y)).

(** ** The edge function with its top-left bias (crates/core/src/raster/edge_function.rs). *)

Definition E (a b : point) (x y : Z) : Z :=
  (X b - X a) * (y - Y a) - (Y b - Y a) * (x - X a).

Definition area2 (a b c : point) : Z := E a b (X c) (Y c).

Definition bias (a b : point) : Z :=
  if (Y b <? Y a) || ((Y b =? Y a) && (X a <? X b)) then 0 else 1.

Definition test (a b : point) (x y : Z) : bool := 0 <=? E a b x y - bias a b.

Definition tests (a b c : point) (x y : Z) : bool :=
  test b c x y && (test c a x y && test a b x y).

(** Clockwise on the screen first, and nothing for no area. *)
Definition edge_cover (a b c : point) (x y : Z) : bool :=
  if area2 a b c =? 0 then false
  else if 0 <? area2 a b c then tests a b c x y else tests a c b x y.

(** Turns booleans that decide integers into the integers' propositions. *)
Ltac decide_all :=
  repeat match goal with
  | |- context [?a <=? ?b] => destruct (Z.leb_spec a b)
  | |- context [?a <? ?b] => destruct (Z.ltb_spec a b)
  | |- context [?a =? ?b] => destruct (Z.eqb_spec a b)
  | H : context [?a <=? ?b] |- _ => destruct (Z.leb_spec a b)
  | H : context [?a <? ?b] |- _ => destruct (Z.ltb_spec a b)
  | H : context [?a =? ?b] |- _ => destruct (Z.eqb_spec a b)
  end.

(** ** The identities everything follows from. *)

Lemma E_sum a b c x y : E b c x y + E c a x y + E a b x y = area2 a b c.
Proof. unfold area2, E; ring. Qed.

Lemma E_balance a b c x y :
  E b c x y * (y - Y a) + E c a x y * (y - Y b) + E a b x y * (y - Y c) = 0.
Proof. unfold E; ring. Qed.

Lemma E_balance_x a b c x y :
  E b c x y * (x - X a) + E c a x y * (x - X b) + E a b x y * (x - X c) = 0.
Proof. unfold E; ring. Qed.

Lemma area2_cycle a b c : area2 b c a = area2 a b c.
Proof. unfold area2, E; ring. Qed.

Lemma area2_flip a b c : area2 a c b = - area2 a b c.
Proof. unfold area2, E; ring. Qed.

Lemma crosses_sym a b x y : crosses a b x y = crosses b a x y.
Proof. unfold crosses; destruct (above a y), (above b y); reflexivity. Qed.

Lemma crosses_down a b x y :
  above a y = true -> above b y = false -> crosses a b x y = (E a b x y <=? 0).
Proof.
  unfold crosses, left_of, E; intros -> ->. decide_all; try reflexivity; lia.
Qed.

Lemma crosses_up a b x y :
  above a y = false -> above b y = true -> crosses a b x y = (0 <=? E a b x y).
Proof.
  unfold crosses, left_of, E; intros -> ->. decide_all; try reflexivity; lia.
Qed.

Lemma crosses_flat a b x y : above a y = above b y -> crosses a b x y = false.
Proof. unfold crosses; intros ->; destruct (above b y); reflexivity. Qed.

(** *** The order of the corners does not matter. *)

Lemma inside_cycle a b c x y : inside b c a x y = inside a b c x y.
Proof.
  unfold inside. destruct (crosses a b x y), (crosses b c x y), (crosses c a x y); reflexivity.
Qed.

Lemma inside_flip a b c x y : inside a c b x y = inside a b c x y.
Proof.
  unfold inside. rewrite (crosses_sym a c), (crosses_sym c b), (crosses_sym b a).
  destruct (crosses a b x y), (crosses b c x y), (crosses c a x y); reflexivity.
Qed.

(** *** Weights: three numbers whose balance is zero. The sample is the mean of the corners with
    the edge functions as weights, so it cannot lie beyond all of them. *)

Lemma balance_pos e f g p q r :
  0 <= e -> 0 <= f -> 0 <= g -> 0 < p -> 0 < q -> 0 < r -> 0 < e + f + g ->
  0 < e * p + f * q + g * r.
Proof.
  intros. assert (0 <= e * p) by nia. assert (0 <= f * q) by nia. assert (0 <= g * r) by nia.
  assert (0 < e \/ 0 < f \/ 0 < g) as [|[|]] by lia; nia.
Qed.

Lemma tests_and a b c x y : tests a b c x y = true <->
  test b c x y = true /\ test c a x y = true /\ test a b x y = true.
Proof. unfold tests; rewrite !andb_true_iff; tauto. Qed.

Lemma test_spec a b x y : test a b x y = true <->
  0 < E a b x y \/ E a b x y = 0 /\ (Y b < Y a \/ Y b = Y a /\ X a < X b).
Proof.
  unfold test, bias.
  destruct (Z.ltb_spec (Y b) (Y a)), (Z.eqb_spec (Y b) (Y a)), (Z.ltb_spec (X a) (X b));
    cbn [orb andb]; rewrite Z.leb_le; lia.
Qed.

Lemma test_E a b x y : test a b x y = true -> 0 <= E a b x y.
Proof. rewrite test_spec; lia. Qed.

(** *** Rows are half-open: nothing above the first corner, nothing from the last one on. *)

Lemma tests_nothing_above a b c x y : 0 < area2 a b c ->
  above a y = false -> above b y = false -> above c y = false -> tests a b c x y = false.
Proof.
  unfold above. rewrite !Z.leb_gt. intros HA Ha Hb Hc.
  apply not_true_iff_false; rewrite tests_and; intros (T1 & T2 & T3).
  apply test_E in T1, T2, T3.
  pose proof (E_sum a b c x y). pose proof (E_balance a b c x y).
  pose proof (balance_pos (E b c x y) (E c a x y) (E a b x y) (Y a - y) (Y b - y) (Y c - y)).
  lia.
Qed.

(** If a weight is not zero, its corner lies at the sample's height; both edges at that corner
    would then have to be top edges. *)
Lemma tests_corner_below a b c x y : 0 < area2 a b c ->
  Y a <= y -> Y b <= y -> Y c <= y -> tests a b c x y = true -> 0 < E b c x y -> False.
Proof.
  intros HA Ha Hb Hc. rewrite tests_and; intros (T1 & T2 & T3) P.
  pose proof (E_balance a b c x y) as B. pose proof (test_E _ _ _ _ T1).
  pose proof (test_E _ _ _ _ T2). pose proof (test_E _ _ _ _ T3).
  assert (0 <= E c a x y * (y - Y b)) by nia. assert (0 <= E a b x y * (y - Y c)) by nia.
  assert (Y a = y) by nia.
  apply test_spec in T2, T3. destruct T2 as [T2 | [T2 D2]].
  - assert (Y b = y) by nia. unfold area2, E in *. nia.
  - unfold area2, E in *. nia.
Qed.

Lemma tests_nothing_below a b c x y : 0 < area2 a b c ->
  above a y = true -> above b y = true -> above c y = true -> tests a b c x y = false.
Proof.
  unfold above. rewrite !Z.leb_le. intros HA Ha Hb Hc.
  apply not_true_iff_false. intros T. pose proof T as T'.
  apply tests_and in T' as (T1 & T2 & T3). apply test_E in T1, T2, T3.
  pose proof (E_sum a b c x y).
  assert (0 < E b c x y \/ 0 < E c a x y \/ 0 < E a b x y) as [P | [P | P]] by lia.
  - exact (tests_corner_below a b c x y HA Ha Hb Hc T P).
  - apply (tests_corner_below b c a x y); auto; [rewrite area2_cycle; auto |].
    apply tests_and in T; apply tests_and; tauto.
  - apply (tests_corner_below c a b x y); auto; [rewrite <- area2_cycle; auto |].
    apply tests_and in T; apply tests_and; tauto.
Qed.

(** *** The edges that cross the row decide, and the third edge agrees with them. *)

Lemma test_down a b x y :
  above a y = true -> above b y = false -> test a b x y = negb (E a b x y <=? 0).
Proof.
  unfold above; rewrite Z.leb_le, Z.leb_gt; intros Ha Hb.
  apply eq_true_iff_eq. rewrite test_spec, negb_true_iff, Z.leb_gt. lia.
Qed.

Lemma test_up a b x y :
  above a y = false -> above b y = true -> test a b x y = (0 <=? E a b x y).
Proof.
  unfold above; rewrite Z.leb_le, Z.leb_gt; intros Ha Hb.
  apply eq_true_iff_eq. rewrite test_spec, Z.leb_le. lia.
Qed.

Lemma tests_one_above a b c x y : 0 < area2 a b c ->
  above a y = true -> above b y = false -> above c y = false ->
  tests a b c x y = inside a b c x y.
Proof.
  intros HA Ha Hb Hc. unfold tests, inside.
  rewrite (crosses_down a b), (crosses_flat b c), (crosses_up c a), (test_down a b), (test_up c a)
    by congruence.
  unfold above in *; rewrite ?Z.leb_le, ?Z.leb_gt in *.
  pose proof (E_sum a b c x y). pose proof (E_balance a b c x y) as B.
  destruct (Z.leb_spec (E a b x y) 0), (Z.leb_spec 0 (E c a x y));
    cbn [negb andb xorb]; rewrite ?andb_false_r, ?andb_true_r; try reflexivity.
  - exfalso. assert (0 <= E c a x y * (y - Y b) + E a b x y * (y - Y c)) by nia. nia.
  - apply test_spec. left.
    assert (0 <= E c a x y * (Y b - y)) by nia. assert (0 < E a b x y * (Y c - y)) by nia. nia.
Qed.

Lemma tests_two_above a b c x y : 0 < area2 a b c ->
  above a y = false -> above b y = true -> above c y = true ->
  tests a b c x y = inside a b c x y.
Proof.
  intros HA Ha Hb Hc. unfold tests, inside.
  rewrite (crosses_up a b), (crosses_flat b c), (crosses_down c a), (test_up a b), (test_down c a)
    by congruence.
  unfold above in *; rewrite ?Z.leb_le, ?Z.leb_gt in *.
  pose proof (E_sum a b c x y). pose proof (E_balance a b c x y) as B.
  destruct (Z.leb_spec (E c a x y) 0), (Z.leb_spec 0 (E a b x y));
    cbn [negb andb xorb]; rewrite ?andb_false_r, ?andb_true_r; try reflexivity.
  - exfalso.
    assert (0 <= - E c a x y * (y - Y b)) by nia. assert (0 <= - E a b x y * (y - Y c)) by nia. nia.
  - apply test_spec.
    assert (0 <= E c a x y * (y - Y b)) by nia. assert (0 <= E a b x y * (y - Y c)) by nia.
    assert (0 <= E b c x y) as [|] % Z.le_lteq by nia; [left; assumption | right].
    assert (E c a x y * (y - Y b) = 0) by nia. assert (Y b = y) by nia.
    split; [congruence |]. destruct (Z.eq_dec (Y c) (Y b)) as [e |]; [right | lia].
    assert (0 < (Y a - Y b) * (X c - X b)) by (unfold area2, E in HA; rewrite e in HA; lia). nia.
Qed.

Lemma tests_cycle a b c x y : tests b c a x y = tests a b c x y.
Proof. unfold tests. destruct (test a b x y), (test b c x y), (test c a x y); reflexivity. Qed.

(** *** The heart: three half-planes with a top-left bias = parity of crossings. *)
Theorem tests_are_parity a b c x y : 0 < area2 a b c -> tests a b c x y = inside a b c x y.
Proof.
  intros HA. pose proof (area2_cycle a b c). pose proof (area2_cycle c a b).
  destruct (above a y) eqn:Ha, (above b y) eqn:Hb, (above c y) eqn:Hc.
  - rewrite tests_nothing_below by assumption. unfold inside. rewrite !crosses_flat by congruence; auto.
  - rewrite (tests_cycle c a b), (inside_cycle c a b). apply tests_two_above; auto; lia.
  - rewrite <- tests_cycle, <- inside_cycle. apply tests_two_above; auto; lia.
  - apply tests_one_above; auto.
  - apply tests_two_above; auto.
  - rewrite <- tests_cycle, <- inside_cycle. apply tests_one_above; auto; lia.
  - rewrite (tests_cycle c a b), (inside_cycle c a b). apply tests_one_above; auto; lia.
  - rewrite tests_nothing_above by assumption. unfold inside. rewrite !crosses_flat by congruence; auto.
Qed.

(** *** No area, no pixels. *)
Theorem inside_degenerate a b c x y : area2 a b c = 0 -> inside a b c x y = false.
Proof.
  intros HA.
  assert (one : forall a b c, area2 a b c = 0 ->
    (above a y = true /\ above b y = false /\ above c y = false \/
     above a y = false /\ above b y = true /\ above c y = true) -> inside a b c x y = false).
  { clear. intros a b c HA H. pose proof (E_sum a b c x y). pose proof (E_balance a b c x y) as B.
    assert (B' : E c a x y * (Y b - Y a) + E a b x y * (Y c - Y a) = 0) by nia.
    unfold inside. destruct H as [(Ha & Hb & Hc) | (Ha & Hb & Hc)].
    - rewrite (crosses_down a b), (crosses_flat b c), (crosses_up c a) by congruence.
      unfold above in *; rewrite ?Z.leb_le, ?Z.leb_gt in *.
      destruct (Z.leb_spec (E a b x y) 0), (Z.leb_spec 0 (E c a x y)); try reflexivity; nia.
    - rewrite (crosses_up a b), (crosses_flat b c), (crosses_down c a) by congruence.
      unfold above in *; rewrite ?Z.leb_le, ?Z.leb_gt in *.
      destruct (Z.leb_spec 0 (E a b x y)), (Z.leb_spec (E c a x y) 0); try reflexivity; nia. }
  pose proof (area2_cycle a b c). pose proof (area2_cycle c a b).
  destruct (above a y) eqn:Ha, (above b y) eqn:Hb, (above c y) eqn:Hc;
    try (unfold inside; rewrite !crosses_flat by congruence; reflexivity);
    solve [ apply one; [lia | tauto]
          | rewrite <- inside_cycle; apply one; [lia | tauto]
          | rewrite (inside_cycle c a b); apply one; [lia | tauto] ].
Qed.

Theorem edge_cover_is_parity a b c x y : edge_cover a b c x y = inside a b c x y.
Proof.
  unfold edge_cover. destruct (Z.eqb_spec (area2 a b c) 0) as [HA | HA].
  - symmetry. apply inside_degenerate; assumption.
  - destruct (Z.ltb_spec 0 (area2 a b c)) as [HP | HN].
    + apply tests_are_parity; assumption.
    + rewrite tests_are_parity by (rewrite area2_flip; lia). apply inside_flip.
Qed.

(** ** A covered sample lies in the bounding box of the corners *)

Definition min3 a b c := Z.min a (Z.min b c).
Definition max3 a b c := Z.max a (Z.max b c).

Lemma range_swap p q r x : min3 p r q <= x <= max3 p r q -> min3 p q r <= x <= max3 p q r.
Proof. unfold min3, max3. rewrite (Z.min_comm r q), (Z.max_comm r q). auto. Qed.

Lemma tests_in_box a b c x y : 0 < area2 a b c -> tests a b c x y = true ->
  min3 (X a) (X b) (X c) <= x <= max3 (X a) (X b) (X c) /\
  min3 (Y a) (Y b) (Y c) <= y <= max3 (Y a) (Y b) (Y c).
Proof.
  intros HA T. apply tests_and in T as (T1 & T2 & T3). apply test_E in T1, T2, T3.
  pose proof (E_sum a b c x y). pose proof (E_balance a b c x y). pose proof (E_balance_x a b c x y).
  assert (P : forall p q r, E b c x y * p + E c a x y * q + E a b x y * r = 0 ->
              0 < p -> 0 < q -> 0 < r -> False).
  { intros p q r H3 Hp Hq Hr.
    pose proof (balance_pos (E b c x y) (E c a x y) (E a b x y) p q r). lia. }
  unfold min3, max3. repeat split; apply Z.nlt_ge; intros L.
  - apply (P (X a - x) (X b - x) (X c - x)); lia.
  - apply (P (x - X a) (x - X b) (x - X c)); lia.
  - apply (P (Y a - y) (Y b - y) (Y c - y)); lia.
  - apply (P (y - Y a) (y - Y b) (y - Y c)); lia.
Qed.

Theorem inside_in_box a b c x y : inside a b c x y = true ->
  min3 (X a) (X b) (X c) <= x <= max3 (X a) (X b) (X c) /\
  min3 (Y a) (Y b) (Y c) <= y <= max3 (Y a) (Y b) (Y c).
Proof.
  rewrite <- edge_cover_is_parity. unfold edge_cover.
  destruct (Z.eqb_spec (area2 a b c) 0); [discriminate |].
  destruct (Z.ltb_spec 0 (area2 a b c)); intros C; apply tests_in_box in C;
    try assumption; [| rewrite area2_flip; lia].
  destruct C. split; eapply range_swap; eassumption.
Qed.
