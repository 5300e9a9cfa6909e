(** Nothing overflows in f64: what RoundedModel.v computes is at most 2^1000, where values are at most 2^500, which
    crates/core/src/triangle.rs demands. The weights that it is computed from have their size in the records [weight] of
    RoundedValues.v. So rounding as if there were no largest number is what f64 does. *)
From Coq Require Import ZArith QArith Qabs Lia Lqa.
From Rasterproof Require RoundedModel.
From Rasterproof Require Import Rounding RoundedForms RoundedValues Planes.
Open Scope Q_scope.

Definition most (k : nat) (x : Q) : Prop := Qabs x <= two k.

(** The largest number of f64 is larger. *)
Lemma two_1000_fits : two 1000 <= inject_Z (2 ^ 1024 - 2 ^ 971).
Proof. apply Qle_bool_iff. vm_compute. reflexivity. Qed.

Lemma most_weaken j k x : (j <= k)%nat -> most j x -> most k x.
Proof. intros H M. exact (Qle_trans _ _ _ M (two_increases j k H)). Qed.

Lemma two_next k : two (k + 1) == 2 * two k.
Proof. rewrite two_add. change (two 1) with 2. ring. Qed.

Lemma most_add k x y : most k x -> most k y -> most (k + 1) (x + y).
Proof. unfold most. intros. pose proof (Qabs_triangle x y). rewrite two_next. lra. Qed.

Lemma most_sub k x y : most k x -> most k y -> most (k + 1) (x - y).
Proof.
  intros. apply most_add; [assumption|]. unfold most. rewrite Qabs_opp. assumption.
Qed.

Lemma most_mul j k x y : most j x -> most k y -> most (j + k) (x * y).
Proof.
  unfold most. intros A B. rewrite Qabs_Qmult, two_add.
  exact (proj2 (product_le _ _ _ _ (conj (Qabs_nonneg x) A) (conj (Qabs_nonneg y) B))).
Qed.

Lemma weight_most n k x x' : weight n k x x' -> most k x'.
Proof.
  intros [_ _ _ [Z | [L U]]]; unfold most.
  - rewrite Z. pose proof (two_at_least_1 k). change (Qabs 0) with 0. lra.
  - pose proof (two_at_least_1 k). assert (0 < x') by nra. rewrite Qabs_pos by lra. exact U.
Qed.

Section Fits.
Variable fl : Q -> Q.
Hypothesis R : rounds fl.

Notation "! z" := (inject_Z z) (at level 5, format "! z").

Lemma most_round k x : most k x -> most (k + 2) (fl x).
Proof.
  unfold most. intros H. pose proof (fl_absolute _ R x) as A. pose proof (Qabs_triangle x (fl x - x)) as T.
  setoid_replace (x + (fl x - x)) with (fl x) in T by ring. rewrite two_add. change (two 2) with 4.
  pose proof (two_at_least_1 k). assert (E : eta <= 1) by (apply Qle_bool_iff; vm_compute; reflexivity).
  set (t := two k) in *. set (e := eta) in *. clearbody t e. unfold u in A. lra.
Qed.

Ltac weaken := match goal with H : most ?j ?x |- most ?k ?x => apply (most_weaken j k x); [cbn; lia | exact H] end.

(** v0 + ((v1 - v0) a1 + (v2 - v0) a2) r, with each operation in it. *)
Lemma offset_fits v0 v1 v2 a1 a2 r : most 500 v0 -> most 500 v1 -> most 500 v2 -> most 71 a1 -> most 71 a2 -> most 405 r ->
  let p1 := fl (fl (v1 - v0) * a1) in let p2 := fl (fl (v2 - v0) * a2) in
  most 503 (fl (v1 - v0)) /\ most 503 (fl (v2 - v0)) /\ most 576 p1 /\ most 576 p2 /\ most 579 (fl (p1 + p2)) /\
  most 986 (fl (fl (p1 + p2) * r)) /\ most 1000 (RoundedModel.offset fl v0 v1 v2 a1 a2 r).
Proof.
  intros V0 V1 V2 A1 A2 Mr. cbv zeta. unfold RoundedModel.offset.
  pose proof (most_round _ _ (most_sub _ _ _ V1 V0)) as D1. pose proof (most_round _ _ (most_sub _ _ _ V2 V0)) as D2.
  pose proof (most_round _ _ (most_mul _ _ _ _ D1 A1)) as P1. pose proof (most_round _ _ (most_mul _ _ _ _ D2 A2)) as P2.
  pose proof (most_round _ _ (most_add _ _ _ P1 P2)) as S. pose proof (most_round _ _ (most_mul _ _ _ _ S Mr)) as X.
  cbn [Nat.add] in *. pose proof (most_weaken 500 986 _ ltac:(lia) V0) as V0'.
  pose proof (most_round _ _ (most_add _ _ _ V0' X)) as F. cbn [Nat.add] in F.
  repeat split; try assumption. apply (most_weaken 989 1000); [lia | exact F].
Qed.

(** v + (w - v) t *)
Lemma between_fits k v w t : most k v -> most k w -> most 1 t ->
  most (k + 3) (fl (w - v)) /\ most (k + 6) (fl (fl (w - v) * t)) /\ most (k + 9) (RoundedModel.between fl v w t).
Proof.
  intros V W T. unfold RoundedModel.between.
  pose proof (most_round _ _ (most_sub _ _ _ W V)) as D. pose proof (most_round _ _ (most_mul _ _ _ _ D T)) as P.
  replace (k + 1 + 2)%nat with (k + 3)%nat in * by lia. replace (k + 3 + 1 + 2)%nat with (k + 6)%nat in * by lia.
  pose proof (most_weaken k (k + 6) _ ltac:(lia) V) as V'. pose proof (most_round _ _ (most_add _ _ _ V' P)) as F.
  replace (k + 6 + 1 + 2)%nat with (k + 9)%nat in F by lia. split; [assumption | split; assumption].
Qed.

Section Edge.
Variables (e0 e1 e2 : Z).
Hypothesis (H0 : (0 <= e0 < 2 ^ 68)%Z) (H1 : (0 <= e1 < 2 ^ 68)%Z) (H2 : (0 <= e2 < 2 ^ 68)%Z).
Hypothesis Harea : (0 < e0 + e1 + e2)%Z.
Variables (w0 w1 w2 largest : Q).
Hypothesis (Hw0 : inv_w w0) (Hw1 : inv_w w1) (Hw2 : inv_w w2) (Hlargest : inv_w largest).
(** It is the largest. *)
Hypothesis (L0 : w0 <= largest) (L1 : w1 <= largest) (L2 : w2 <= largest).
Variables (v0 v1 v2 : Q).
Hypothesis (V0 : most 500 v0) (V1 : most 500 v1) (V2 : most 500 v2).

Lemma edge_weight_most e w : (0 <= e < 2 ^ 68)%Z -> inv_w w -> w <= largest -> most 71 (RoundedModel.edge_weight fl largest e w).
Proof.
  intros He Hw L. destruct (inv_w_weight _ Hw) as [P _]. destruct (inv_w_weight _ Hlargest) as [Pl _].
  pose proof (edge_weight_weight fl R largest Hlargest e w He Hw) as W.
  assert (Q0 : 0 <= w / largest) by (apply Qle_shift_div_l; lra). assert (Q1 : w / largest <= 1) by (apply Qle_shift_div_r; lra).
  assert (E : Qabs (!e * (w / largest)) <= two 68).
  { rewrite Qabs_Qmult, (Qabs_pos (w / largest)) by assumption. assert (I : Qabs !e <= two 68).
    { rewrite Qabs_pos by (change 0 with (inject_Z 0); rewrite <- Zle_Qle; lia). unfold two. rewrite <- Zle_Qle. change (Z.of_nat 68) with 68%Z. lia. }
    destruct (product_le _ _ _ _ (conj (Qabs_nonneg !e) I) (conj Q0 Q1)) as [_ F]. rewrite Qmult_1_r in F. exact F. }
  pose proof (approx_error 3 _ _ ltac:(lia) (w_approx _ _ _ _ W)) as A. unfold most.
  set (x := RoundedModel.edge_weight fl largest e w) in *. set (y := !e * (w / largest)) in *.
  pose proof (Qabs_triangle y (x - y)) as T. setoid_replace (y + (x - y)) with x in T by ring.
  assert (D : drift 3 <= 1) by (apply Qle_bool_iff; vm_compute; reflexivity). pose proof (Qabs_nonneg y).
  assert (B : drift 3 * Qabs y <= 1 * Qabs y) by (apply Qmult_le_compat_r; assumption).
  apply (Qle_trans _ (2 * two 68)); [lra|]. apply Qle_bool_iff. vm_compute. reflexivity.
Qed.

Notation weight_of := (RoundedModel.edge_weight fl largest).
Notation sum := (fl (fl (weight_of e0 w0 + weight_of e1 w1) + weight_of e2 w2)).

(** The relative 1/w, the weights, their sums, the reciprocal, and the rest by [offset_fits]. *)
Theorem edge_attribute_fits : (forall w, inv_w w -> most 1000 (fl (w / largest))) /\
  most 1000 (weight_of e0 w0) /\ most 1000 (weight_of e1 w1) /\ most 1000 (weight_of e2 w2) /\
  most 1000 (fl (weight_of e0 w0 + weight_of e1 w1)) /\ most 1000 sum /\ most 1000 (fl (1 / sum)) /\
  most 1000 (RoundedModel.edge_attribute fl e0 e1 e2 w0 w1 w2 largest v0 v1 v2).
Proof.
  pose proof (edge_weight_most e0 w0 H0 Hw0 L0) as W0. pose proof (edge_weight_most e1 w1 H1 Hw1 L1) as W1.
  pose proof (edge_weight_most e2 w2 H2 Hw2 L2) as W2.
  pose proof (most_round _ _ (most_add _ _ _ W0 W1)) as S1. cbn [Nat.add] in S1.
  pose proof (most_round _ _ (most_add _ _ _ S1 (most_weaken 71 74 _ ltac:(lia) W2))) as S2. cbn [Nat.add] in S2.
  destruct (edge_reciprocal fl R e0 e1 e2 H0 H1 H2 Harea w0 w1 w2 largest Hw0 Hw1 Hw2 Hlargest) as [_ [r0 r1]].
  assert (Mr : most 405 (fl (1 / sum))).
  { unfold most. rewrite Qabs_pos by exact r0. exact r1. }
  split; [|repeat split].
  - intros w Hw. exact (most_weaken 401 1000 _ ltac:(lia) (weight_most _ _ _ _ (relative_weight fl R w largest Hw Hlargest))).
  - exact (most_weaken 71 1000 _ ltac:(lia) W0).
  - exact (most_weaken 71 1000 _ ltac:(lia) W1).
  - exact (most_weaken 71 1000 _ ltac:(lia) W2).
  - exact (most_weaken 74 1000 _ ltac:(lia) S1).
  - exact (most_weaken 77 1000 _ ltac:(lia) S2).
  - exact (most_weaken 405 1000 _ ltac:(lia) Mr).
  - exact (proj2 (proj2 (proj2 (proj2 (proj2 (proj2 (offset_fits v0 v1 v2 _ _ _ V0 V1 V2 W1 W2 Mr))))))).
Qed.

Theorem edge_depth_fits : most 1000 (fl !e1) /\ most 1000 (fl !e2) /\ most 1000 (fl !(e0 + e1 + e2)) /\
  most 1000 (fl (1 / fl !(e0 + e1 + e2))) /\ most 1000 (RoundedModel.edge_depth fl e0 e1 e2 v0 v1 v2).
Proof.
  pose proof (integer_from_1 _ Harea) as Hs. assert (Hs0 : 0 < !(e0 + e1 + e2)) by lra.
  assert (Ha : (0 <= e0 + e1 + e2 < 2 ^ Z.of_nat 70)%Z) by (change (2 ^ Z.of_nat 70)%Z with (4 * 2 ^ 68)%Z; lia).
  pose proof (weight_most _ _ _ _ (weight_integer fl R 68 e1 ltac:(lia) H1)) as W1. cbn [Nat.add] in W1.
  pose proof (weight_most _ _ _ _ (weight_integer fl R 68 e2 ltac:(lia) H2)) as W2. cbn [Nat.add] in W2.
  pose proof (weight_integer fl R 70 _ ltac:(lia) Ha) as Wa. pose proof (weight_exact 1 1 ltac:(cbn; lia)) as W.
  pose proof (weight_most _ _ _ _ (weight_div fl R 0 1 1 71 _ _ _ _ ltac:(lia) Hs0 W Wa)) as Wr. change (!1) with 1 in Wr. cbn [Nat.add] in Wr.
  repeat split.
  - exact (most_weaken 69 1000 _ ltac:(lia) W1).
  - exact (most_weaken 69 1000 _ ltac:(lia) W2).
  - exact (most_weaken 71 1000 _ ltac:(lia) (weight_most _ _ _ _ Wa)).
  - exact (most_weaken 73 1000 _ ltac:(lia) Wr).
  - exact (proj2 (proj2 (proj2 (proj2 (proj2 (proj2 (offset_fits v0 v1 v2 _ _ _ V0 V1 V2 (most_weaken 69 71 _ ltac:(lia) W1)
      (most_weaken 69 71 _ ltac:(lia) W2) (most_weaken 73 405 _ ltac:(lia) Wr)))))))).
Qed.
End Edge.

(** A parameter after a few roundings. *)
Lemma parameter_most n t t' : (n <= 20)%nat -> 0 <= t <= 1 -> approx n t t' -> most 1 t'.
Proof.
  intros Hn T A. pose proof (approx_error n _ _ Hn A) as E. pose proof (Qabs_triangle t (t' - t)) as Tr.
  setoid_replace (t + (t' - t)) with t' in Tr by ring. rewrite (Qabs_pos t) in * by lra. unfold most. change (two 1) with 2.
  assert (D : drift n <= 1).
  { apply Qle_trans with (drift 20); [|apply Qle_bool_iff; vm_compute; reflexivity].
    unfold drift. apply Qmult_le_compat_r; [rewrite <- Zle_Qle; lia | discriminate]. }
  assert (B : drift n * t <= 1 * t) by (apply Qmult_le_compat_r; lra). lra.
Qed.

Lemma near_parameter_most t t' e : 0 <= t <= 1 -> Qabs (t' - t) <= e -> e <= 1 -> most 1 t'.
Proof.
  intros T E L. pose proof (Qabs_triangle t (t' - t)) as Tr. setoid_replace (t + (t' - t)) with t' in Tr by ring.
  rewrite (Qabs_pos t) in Tr by lra. unfold most. change (two 1) with 2. lra.
Qed.

Theorem line_fits i n a b : (0 <= i <= n)%Z -> (0 < n < 2 ^ 33)%Z -> most 500 a -> most 500 b ->
  most 1000 (fl (b - a)) /\ most 1 (fl (!i / !n)) /\ most 1000 (fl (fl (b - a) * fl (!i / !n))) /\
  most 1000 (RoundedModel.line_value fl i n a b).
Proof.
  intros Hi Hn A B. destruct (share_of_integers fl R i n 33 Hi Hn ltac:(lia)) as [W T].
  pose proof (parameter_most 1 _ _ ltac:(lia) T (w_approx _ _ _ _ W)) as P.
  destruct (between_fits 500 a b _ A B P) as (X & Y & Z). cbn [Nat.add] in *. repeat split.
  - exact (most_weaken 503 1000 _ ltac:(lia) X).
  - exact P.
  - exact (most_weaken 506 1000 _ ltac:(lia) Y).
  - exact (most_weaken 509 1000 _ ltac:(lia) Z).
Qed.

Section Row.
Variables (l r : Z).
Hypothesis (Hl : (0 <= l < 2 ^ 68)%Z) (Hr : (0 < r < 2 ^ 68)%Z).
Variables (below1 above1 height1 below2 above2 height2 : Z).
Hypothesis (Hb1 : (0 <= below1)%Z) (Ha1 : (0 < above1)%Z) (Hs1 : (below1 + above1 = height1)%Z) (Hh1 : (height1 < 2 ^ 33)%Z).
Hypothesis (Hb2 : (0 <= below2)%Z) (Ha2 : (0 < above2)%Z) (Hs2 : (below2 + above2 = height2)%Z) (Hh2 : (height2 < 2 ^ 33)%Z).
Variables (va vb vc vd : Q).
Hypothesis (Va : most 500 va) (Vb : most 500 vb) (Vc : most 500 vc) (Vd : most 500 vd).

(** The depths at both ends of the row, the parameter between them, and the depth. *)
Theorem scanline_depth_fits l0 r0 : (0 <= l0 < 2 ^ 68)%Z -> (0 < r0 < 2 ^ 68)%Z ->
  (l0 * height2 + r0 * height1 = l * height2 + r * height1)%Z ->
  most 509 (RoundedModel.row_depth fl below1 height1 va vb) /\ most 509 (RoundedModel.row_depth fl below2 height2 vc vd) /\
  most 1 (RoundedModel.depth_place fl l l0 r0 height1 height2) /\
  most 1000 (RoundedModel.scanline_depth fl l below1 height1 below2 height2 l0 r0 va vb vc vd).
Proof.
  intros Hl0 Hr0 Hw.
  destruct (share_of_integers fl R below1 height1 33 ltac:(lia) ltac:(cbn; lia) ltac:(lia)) as [W1 T1].
  destruct (share_of_integers fl R below2 height2 33 ltac:(lia) ltac:(cbn; lia) ltac:(lia)) as [W2 T2].
  destruct (between_fits 500 va vb _ Va Vb (parameter_most 1 _ _ ltac:(lia) T1 (w_approx _ _ _ _ W1))) as (_ & _ & L).
  destruct (between_fits 500 vc vd _ Vc Vd (parameter_most 1 _ _ ltac:(lia) T2 (w_approx _ _ _ _ W2))) as (_ & _ & U).
  destruct (depth_place_error fl R l r Hl Hr l0 r0 height1 height2 Hl0 Hr0 ltac:(lia) ltac:(lia) Hw) as (E & _ & T).
  assert (D : drift 7 <= 1) by (apply Qle_bool_iff; vm_compute; reflexivity). pose proof (near_parameter_most _ _ _ T E D) as P.
  cbn [Nat.add] in L, U. destruct (between_fits 509 _ _ _ L U P) as (_ & _ & F). cbn [Nat.add] in F.
  split; [exact L | split; [exact U | split; [exact P|]]]. exact (most_weaken 518 1000 _ ltac:(lia) F).
Qed.

Variables (wa wb wc wd largest : Q).
Hypothesis (Hwa : inv_w wa) (Hwb : inv_w wb) (Hwc : inv_w wc) (Hwd : inv_w wd) (Hlargest : inv_w largest).

Notation relative := (RoundedModel.relative fl largest).
Notation left_q := (RoundedModel.row_q fl below1 above1 height1 (relative wa) (relative wb)).
Notation right_q := (RoundedModel.row_q fl below2 above2 height2 (relative wc) (relative wd)).

(** 1/w and the attributes at both ends of the row, the parameter between them, and the attribute. *)
Theorem scanline_attribute_fits : most 1000 left_q /\ most 1000 right_q /\
  most 509 (RoundedModel.row_value fl below1 above1 (relative wa) (relative wb) va vb) /\
  most 509 (RoundedModel.row_value fl below2 above2 (relative wc) (relative wd) vc vd) /\
  most 1 (RoundedModel.row_place fl l r left_q right_q) /\
  most 1000 (RoundedModel.scanline_attribute fl l r below1 above1 height1 below2 above2 height2 wa wb wc wd largest va vb vc vd).
Proof.
  destruct (relative_positive fl R largest Hlargest wa Hwa) as (Pa & Wa & _).
  destruct (relative_positive fl R largest Hlargest wb Hwb) as (Pb & Wb & _).
  destruct (relative_positive fl R largest Hlargest wc Hwc) as (Pc & Wc & _).
  destruct (relative_positive fl R largest Hlargest wd Hwd) as (Pd & Wd & _).
  destruct (row_share fl R below1 above1 height1 Hb1 Ha1 Hs1 Hh1 _ _ Wa Wb Pa Pb) as [A1 T1].
  destruct (row_share fl R below2 above2 height2 Hb2 Ha2 Hs2 Hh2 _ _ Wc Wd Pc Pd) as [A2 T2].
  destruct (between_fits 500 va vb _ Va Vb (parameter_most 4 _ _ ltac:(lia) T1 A1)) as (_ & _ & L).
  destruct (between_fits 500 vc vd _ Vc Vd (parameter_most 4 _ _ ltac:(lia) T2 A2)) as (_ & _ & U).
  pose proof (row_q_weight fl R below1 above1 height1 Hb1 Ha1 Hs1 Hh1 _ _ Wa Wb) as Q1.
  pose proof (row_q_weight fl R below2 above2 height2 Hb2 Ha2 Hs2 Hh2 _ _ Wc Wd) as Q2.
  pose proof (exact_sum_positive below1 above1 Hb1 Ha1 _ _ Pa Pb) as S1.
  pose proof (exact_sum_positive below2 above2 Hb2 Ha2 _ _ Pc Pd) as S2.
  destruct (row_place_error fl R l r Hl Hr _ _ _ _ S1 S2 Q1 Q2) as (E & _ & T).
  assert (D : drift 6 / (2 * low 6) + drift 3 + eta <= 1) by (apply Qle_bool_iff; vm_compute; reflexivity).
  pose proof (near_parameter_most _ _ _ T E D) as P. cbn [Nat.add] in L, U.
  destruct (between_fits 509 _ _ _ L U P) as (_ & _ & F). cbn [Nat.add] in F.
  split; [exact (most_weaken 505 1000 _ ltac:(lia) (weight_most _ _ _ _ Q1))|].
  split; [exact (most_weaken 505 1000 _ ltac:(lia) (weight_most _ _ _ _ Q2))|].
  split; [exact L | split; [exact U | split; [exact P|]]]. exact (most_weaken 518 1000 _ ltac:(lia) F).
Qed.
End Row.
End Fits.
