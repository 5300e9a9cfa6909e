(** What rounding makes of the values of both engines and of lines: the factors of
    crates/verify/src/comparison/tolerance.rs, for the operations of crates/core/src/raster/edge_function/values.rs,
    crates/core/src/raster/scanline/values.rs and crates/core/src/line, in their order. [fl] is the rounding of each
    operation. Domain: whole-number weights below 2^68, 1/w from 2^-200 to 2^200, finite values. *)
From Coq Require Import ZArith QArith Qabs Lia Lqa Bool List.
From Rasterproof Require RoundedModel.
From Rasterproof Require Import Rounding RoundedForms.
Import ListNotations.
Open Scope Q_scope.

Section Engines.
Variable fl : Q -> Q.
Hypothesis R : rounds fl.

Notation "! z" := (inject_Z z) (at level 5, format "! z").

Lemma integer_from_0 z : (0 <= z)%Z -> 0 <= !z.
Proof. intros. change 0 with (inject_Z 0). rewrite <- Zle_Qle. assumption. Qed.

Lemma integer_from_1 z : (0 < z)%Z -> 1 <= !z.
Proof. intros. change 1 with (inject_Z 1). rewrite <- Zle_Qle. lia. Qed.

Definition inv_w (w : Q) : Prop := is_float w /\ sized 200 w.

Lemma inv_w_weight w : inv_w w -> 0 < w /\ weight 0 200 w w.
Proof.
  intros [F S]. pose proof S as [L U]. pose proof (two_at_least_1 200). assert (0 < w) by nra.
  split; [assumption|]. split; [lra | apply approx_refl | assumption | right; assumption].
Qed.

(** 1/w over the largest of the three. *)
Lemma relative_weight w largest : inv_w w -> inv_w largest -> weight 1 401 (w / largest) (fl (w / largest)).
Proof.
  intros Hw Hl. destruct (inv_w_weight _ Hw) as [_ W]. destruct (inv_w_weight _ Hl) as [P V].
  exact (weight_div fl R 0 200 0 200 _ _ _ _ ltac:(lia) P W V).
Qed.

Lemma relative_least w largest : inv_w w -> inv_w largest -> 1 <= w / largest * two 400.
Proof.
  intros [_ [L _]] Hl. destruct (inv_w_weight _ Hl) as [P _]. destruct Hl as [_ [_ U]].
  change 400%nat with (200 + 200)%nat. rewrite two_add. pose proof (two_at_least_1 200). set (t := two 200) in *.
  setoid_replace (w / largest * (t * t)) with (w * t * t / largest) by (field; lra).
  apply Qle_shift_div_l; [assumption|]. nra.
Qed.

(** ** The edge-function engine *)

Section EdgeFunction.
Variables (e0 e1 e2 : Z).
Hypothesis (H0 : (0 <= e0 < 2 ^ 68)%Z) (H1 : (0 <= e1 < 2 ^ 68)%Z) (H2 : (0 <= e2 < 2 ^ 68)%Z).
Hypothesis Harea : (0 < e0 + e1 + e2)%Z.

Notation edge_depth := (RoundedModel.edge_depth fl e0 e1 e2).

Definition exact_depth (z0 z1 z2 : Q) : Q := (!e0 * z0 + !e1 * z1 + !e2 * z2) / !(e0 + e1 + e2).

Lemma mean_in_hull a b c va vb vc M : 0 <= a -> 0 <= b -> 0 <= c -> 0 < a + b + c ->
  Qabs va <= M -> Qabs vb <= M -> Qabs vc <= M -> Qabs ((a * va + b * vb + c * vc) / (a + b + c)) <= M.
Proof.
  intros Ha Hb Hc Hs Ma Mb Mc. apply abs_le in Ma, Mb, Mc. apply abs_le. split.
  - apply Qle_shift_div_l; [assumption|]. nra.
  - apply Qle_shift_div_r; [assumption|]. nra.
Qed.

Lemma bound_sharper d m D M : 0 <= D -> 0 <= M -> near_bound d m D M <= bound d m D M.
Proof.
  intros. unfold near_bound, bound.
  assert (0 <= !(Z.of_nat d)) by (apply integer_from_0; lia).
  assert (0 <= !(Z.of_nat m)) by (apply integer_from_0; lia).
  assert (0 <= !(Z.of_nat d) * D + !(Z.of_nat m) * M) by nra.
  set (x := !(Z.of_nat d) * D + !(Z.of_nat m) * M) in *. clearbody x.
  assert (1 # 2 ^ 666 <= underflow) by (apply Qle_bool_iff; vm_compute; reflexivity).
  unfold second_order, u. set (tiny := 1 # 2 ^ 666) in *. set (under := underflow) in *. clearbody tiny under. lra.
Qed.

Theorem edge_depth_error z0 z1 z2 D M : is_float z0 -> is_float z1 -> is_float z2 ->
  Qabs (z1 - z0) <= D -> Qabs (z2 - z0) <= D -> Qabs z0 <= M -> Qabs z1 <= M -> Qabs z2 <= M ->
  Qabs (edge_depth z0 z1 z2 - exact_depth z0 z1 z2) <= bound 7 1 D M.
Proof.
  intros F0 F1 F2 D1 D2 M0 M1 M2. unfold RoundedModel.edge_depth.
  assert (P0 : 0 <= !e0) by (apply integer_from_0; lia). assert (P1 : 0 <= !e1) by (apply integer_from_0; lia).
  assert (P2 : 0 <= !e2) by (apply integer_from_0; lia).
  pose proof (integer_from_1 _ Harea) as Hs. pose proof (inject_Z_plus (e0 + e1) e2) as S.
  rewrite (inject_Z_plus e0 e1) in S. assert (Hs' : 0 < !e0 + !e1 + !e2) by (rewrite <- S; lra).
  pose proof (weight_integer fl R 68 e1 ltac:(lia) H1) as W1.
  pose proof (weight_integer fl R 68 e2 ltac:(lia) H2) as W2.
  assert (Ha : (0 <= e0 + e1 + e2 < 2 ^ Z.of_nat 70)%Z) by (change (2 ^ Z.of_nat 70)%Z with (4 * 2 ^ 68)%Z; lia).
  pose proof (weight_integer fl R 70 _ ltac:(lia) Ha) as Wa.
  pose proof (weight_exact 1 1 ltac:(cbn; lia)) as W.
  assert (Hs0 : 0 < !(e0 + e1 + e2)) by lra.
  pose proof (weight_div fl R 0 1 1 71 _ _ _ _ ltac:(lia) Hs0 W Wa) as Wr. change (!1) with 1 in Wr.
  assert (E : exact_depth z0 z1 z2 ==
    z0 + ((z1 - z0) * !e1 + (z2 - z0) * !e2) / !(e0 + e1 + e2)).
  { unfold exact_depth. rewrite S. field. lra. }
  assert (V : Qabs (exact_depth z0 z1 z2) <= M).
  { unfold exact_depth. rewrite S. apply mean_in_hull; assumption. }
  rewrite E in *.
  apply (offset_error fl R 1 2); try assumption; try lia.
  - rewrite S. lra.
  - apply (w_approx _ _ _ _ W1).
  - apply (w_approx _ _ _ _ W2).
  - eapply approx_eq; [apply (w_approx _ _ _ _ Wr) | field; lra | reflexivity].
  - destruct (approx_at _ _ _ (w_approx _ _ _ _ Wr)) as (A & _ & _); [apply (w_exact _ _ _ _ Wr)|].
    split; [assumption|]. destruct (w_sized _ _ _ _ Wr) as [Z | [_ U]].
    + rewrite Z. apply Qle_bool_iff. vm_compute. reflexivity.
    + eapply Qle_trans; [exact U|]. apply Qle_bool_iff. vm_compute. reflexivity.
Qed.

Variables (w0 w1 w2 largest : Q).
Hypothesis (Hw0 : inv_w w0) (Hw1 : inv_w w1) (Hw2 : inv_w w2) (Hlargest : inv_w largest).

Notation edge_weight := (RoundedModel.edge_weight fl largest).

Notation edge_attribute := (RoundedModel.edge_attribute fl e0 e1 e2 w0 w1 w2 largest).

Definition exact_attribute (v0 v1 v2 : Q) : Q :=
  (!e0 * w0 * v0 + !e1 * w1 * v1 + !e2 * w2 * v2) / (!e0 * w0 + !e1 * w1 + !e2 * w2).

Lemma edge_weight_weight e w : (0 <= e < 2 ^ 68)%Z -> inv_w w ->
  weight 3 471 (!e * (w / largest)) (edge_weight e w).
Proof.
  intros He Hw. pose proof (weight_integer fl R 68 e ltac:(lia) He) as W1.
  pose proof (relative_weight w largest Hw Hlargest) as W2.
  exact (weight_mul fl R 1 69 1 401 _ _ _ _ ltac:(lia) W1 W2).
Qed.

(** The sum of the weights, and its reciprocal as it is computed. *)
Definition exact_weights : Q := !e0 * (w0 / largest) + !e1 * (w1 / largest) + !e2 * (w2 / largest).

Notation computed_weights := (fl (fl (edge_weight e0 w0 + edge_weight e1 w1) + edge_weight e2 w2)).

Lemma edge_weights : weight 5 475 exact_weights computed_weights.
Proof.
  pose proof (edge_weight_weight e0 w0 H0 Hw0) as W0. pose proof (edge_weight_weight e1 w1 H1 Hw1) as W1.
  pose proof (edge_weight_weight e2 w2 H2 Hw2) as W2.
  pose proof (weight_add fl R 3 471 _ _ _ _ ltac:(lia) W0 W1) as S1.
  exact (weight_add fl R 4 473 _ _ _ _ ltac:(lia) S1 (weight_weaken 3 471 4 473 _ _ ltac:(lia) ltac:(lia) W2)).
Qed.

(** Some weight is at least 1, so the sum is at least 2^-400. *)
Lemma edge_weights_least : 1 <= exact_weights * two 400.
Proof.
  assert (P0 : 0 <= !e0) by (apply integer_from_0; lia). assert (P1 : 0 <= !e1) by (apply integer_from_0; lia).
  assert (P2 : 0 <= !e2) by (apply integer_from_0; lia).
  pose proof (relative_least w0 largest Hw0 Hlargest) as B0. pose proof (relative_least w1 largest Hw1 Hlargest) as B1.
  pose proof (relative_least w2 largest Hw2 Hlargest) as B2. pose proof (integer_from_1 _ Harea) as Hs.
  rewrite !inject_Z_plus in Hs. unfold exact_weights.
  setoid_replace ((!e0 * (w0 / largest) + !e1 * (w1 / largest) + !e2 * (w2 / largest)) * two 400) with
    (!e0 * (w0 / largest * two 400) + !e1 * (w1 / largest * two 400) + !e2 * (w2 / largest * two 400)) by ring.
  set (a := w0 / largest * two 400) in *. set (b := w1 / largest * two 400) in *.
  set (c := w2 / largest * two 400) in *. clearbody a b c.
  assert (!e0 <= !e0 * a) by nra. assert (!e1 <= !e1 * b) by nra. assert (!e2 <= !e2 * c) by nra. lra.
Qed.

Lemma edge_reciprocal : weight 6 477 (1 / exact_weights) (fl (1 / computed_weights)) /\
  0 <= fl (1 / computed_weights) <= largest_inverse.
Proof.
  pose proof edge_weights_least as Least. pose proof (two_at_least_1 400) as T. set (s := exact_weights) in *.
  assert (Ps : 0 < s) by nra.
  pose proof (weight_exact 1 1 ltac:(cbn; lia)) as W. change (!1) with 1 in W.
  pose proof (weight_div fl R 0 1 5 475 _ _ _ _ ltac:(lia) Ps W edge_weights) as Wr. split; [exact Wr|].
  destruct (approx_at _ _ _ (w_approx _ _ _ _ Wr)) as (A & _ & U); [apply (w_exact _ _ _ _ Wr)|].
  split; [assumption|].
  assert (Hinv : 1 / s <= two 400) by (apply Qle_shift_div_r; [assumption | lra]).
  assert (Hl : two 400 <= largest_inverse * low (0 + 5 + 1)) by (apply Qle_bool_iff; vm_compute; reflexivity).
  pose proof (low_bounds (0 + 5 + 1)). cbn [Nat.add] in *.
  destruct (Qlt_le_dec largest_inverse (fl (1 / computed_weights))); [exfalso; nra | assumption].
Qed.

Theorem edge_attribute_error v0 v1 v2 D M : is_float v0 -> is_float v1 -> is_float v2 ->
  Qabs (v1 - v0) <= D -> Qabs (v2 - v0) <= D -> Qabs v0 <= M -> Qabs v1 <= M -> Qabs v2 <= M ->
  Qabs (edge_attribute v0 v1 v2 - exact_attribute v0 v1 v2) <= bound 13 1 D M.
Proof.
  intros F0 F1 F2 D1 D2 M0 M1 M2. unfold RoundedModel.edge_attribute.
  assert (P0 : 0 <= !e0) by (apply integer_from_0; lia). assert (P1 : 0 <= !e1) by (apply integer_from_0; lia).
  assert (P2 : 0 <= !e2) by (apply integer_from_0; lia).
  pose proof (edge_weight_weight e0 w0 H0 Hw0) as W0. pose proof (edge_weight_weight e1 w1 H1 Hw1) as W1.
  pose proof (edge_weight_weight e2 w2 H2 Hw2) as W2.
  destruct (inv_w_weight _ Hw0) as [Q0 _]. destruct (inv_w_weight _ Hw1) as [Q1 _].
  destruct (inv_w_weight _ Hw2) as [Q2 _]. destruct (inv_w_weight _ Hlargest) as [QL _].
  pose proof edge_weights_least as Least. destruct edge_reciprocal as [Wr Small]. unfold exact_weights in *.
  set (s := !e0 * (w0 / largest) + !e1 * (w1 / largest) + !e2 * (w2 / largest)) in *.
  pose proof (two_at_least_1 400) as T. assert (Ps : 0 < s) by nra.
  assert (Hsum : !e0 * w0 + !e1 * w1 + !e2 * w2 == s * largest) by (unfold s; field; lra).
  assert (Hpos : 0 < !e0 * w0 + !e1 * w1 + !e2 * w2) by (rewrite Hsum; apply Qmult_lt_0_compat; assumption).
  assert (E : exact_attribute v0 v1 v2 ==
    v0 + ((v1 - v0) * (!e1 * (w1 / largest)) + (v2 - v0) * (!e2 * (w2 / largest))) / s).
  { unfold exact_attribute. rewrite Hsum. unfold s in *. field. split; lra. }
  assert (V : Qabs (exact_attribute v0 v1 v2) <= M).
  { unfold exact_attribute. apply mean_in_hull; try assumption; nra. }
  rewrite E in *.
  assert (N0 : 0 <= !e0 * (w0 / largest)) by apply (w_exact _ _ _ _ W0).
  apply (offset_error fl R 3 6); try assumption; try lia.
  - apply (w_exact _ _ _ _ W1).
  - apply (w_exact _ _ _ _ W2).
  - unfold s. lra.
  - apply (w_approx _ _ _ _ W1).
  - apply (w_approx _ _ _ _ W2).
  - eapply approx_eq; [apply (w_approx _ _ _ _ Wr) | field; lra | reflexivity].
Qed.
End EdgeFunction.

(** ** Lines *)

Notation line_value := (RoundedModel.line_value fl).

Lemma share_of_integers i n k : (0 <= i <= n)%Z -> (0 < n < 2 ^ Z.of_nat k)%Z -> (k <= 100)%nat ->
  weight 1 (k + k + 1) (!i / !n) (fl (!i / !n)) /\ 0 <= !i / !n <= 1.
Proof.
  intros Hi Hn Hk. pose proof (integer_from_1 n ltac:(lia)) as Pn.
  assert (Pn0 : 0 < !n) by lra.
  pose proof (weight_exact k i ltac:(lia)) as Wi. pose proof (weight_exact k n ltac:(lia)) as Wn.
  split; [exact (weight_div fl R 0 k 0 k _ _ _ _ ltac:(lia) Pn0 Wi Wn)|].
  pose proof (integer_from_0 i ltac:(lia)).
  assert (!i <= !n) by (rewrite <- Zle_Qle; lia).
  split; [apply Qle_shift_div_l; lra | apply Qle_shift_div_r; lra].
Qed.

Lemma hull a b t M : 0 <= t <= 1 -> Qabs a <= M -> Qabs b <= M -> Qabs (a + (b - a) * t) <= M.
Proof.
  intros Ht Ha Hb. apply abs_le in Ha, Hb. apply abs_le.
  setoid_replace (a + (b - a) * t) with ((1 - t) * a + t * b) by ring. split; nra.
Qed.

Theorem line_error i n a b D M : (0 <= i <= n)%Z -> (0 < n < 2 ^ 33)%Z -> is_float a -> is_float b ->
  Qabs (b - a) <= D -> Qabs a <= M -> Qabs b <= M ->
  Qabs (line_value i n a b - (a + (b - a) * (!i / !n))) <= bound 3 1 D M.
Proof.
  intros Hi Hn Fa Fb HD Ma Mb. destruct (share_of_integers i n 33 Hi Hn ltac:(lia)) as [W T].
  eapply Qle_trans.
  - unfold RoundedModel.line_value. apply (between_error fl R 1 a b (!i / !n) _ D M); try assumption; try lia.
    + apply (w_approx _ _ _ _ W).
    + apply hull; assumption.
  - apply bound_sharper; [pose proof (Qabs_nonneg (b - a)) | pose proof (Qabs_nonneg a)]; lra.
Qed.

(** ** The scanline engine *)

Notation row_depth := (RoundedModel.row_depth fl).

Notation row_sum := (RoundedModel.row_sum fl).

Notation row_value := (RoundedModel.row_value fl).

Notation row_q := (RoundedModel.row_q fl).

Section Edge.
Variables (below above height : Z).
Hypothesis (Hb : (0 <= below)%Z) (Ha : (0 < above)%Z) (Hsum : (below + above = height)%Z) (Hh : (height < 2 ^ 33)%Z).

Theorem row_depth_error za zb D M : is_float za -> is_float zb ->
  Qabs (zb - za) <= D -> Qabs za <= M -> Qabs zb <= M ->
  Qabs (row_depth below height za zb - (za + (zb - za) * (!below / !height))) <= near_bound 3 1 D M.
Proof.
  intros Fa Fb HD Ma Mb.
  assert (Hi : (0 <= below <= height)%Z) by lia. assert (Hn : (0 < height < 2 ^ Z.of_nat 33)%Z) by (cbn; lia).
  destruct (share_of_integers below height 33 Hi Hn ltac:(lia)) as [W T].
  unfold RoundedModel.row_depth. apply (between_error fl R 1); try assumption; try lia.
  - apply (w_approx _ _ _ _ W).
  - apply hull; assumption.
Qed.

(** The relative 1/w are what they are here; that they were rounded is counted for the whole row. *)
Variables (qa qb : Q).
Hypothesis (Wa : weight 0 401 qa qa) (Wb : weight 0 401 qb qb) (Pa : 0 < qa) (Pb : 0 < qb).

Definition exact_sum : Q := !above * qa + !below * qb.

Lemma exact_sum_positive : 0 < exact_sum.
Proof.
  unfold exact_sum. pose proof (integer_from_1 _ Ha). pose proof (integer_from_0 _ Hb). nra.
Qed.

Lemma row_sum_weight : weight 1 435 (!below * qb) (fl (!below * qb)) /\
  weight 2 437 exact_sum (row_sum below above qa qb).
Proof.
  pose proof (weight_exact 33 above ltac:(cbn; lia)) as Wx. pose proof (weight_exact 33 below ltac:(cbn; lia)) as Wy.
  pose proof (weight_mul fl R 0 33 0 401 _ _ _ _ ltac:(lia) Wx Wa) as X.
  pose proof (weight_mul fl R 0 33 0 401 _ _ _ _ ltac:(lia) Wy Wb) as Y.
  split; [exact Y|]. exact (weight_add fl R 1 435 _ _ _ _ ltac:(lia) X Y).
Qed.

Lemma row_share : approx 4 (!below * qb / exact_sum) (fl (fl (!below * qb) / row_sum below above qa qb)) /\
  0 <= !below * qb / exact_sum <= 1.
Proof.
  destruct row_sum_weight as [Y S]. pose proof exact_sum_positive as P. split.
  - exact (w_approx _ _ _ _ (weight_div fl R 1 435 2 437 _ _ _ _ ltac:(lia) P Y S)).
  - pose proof (integer_from_1 _ Ha). pose proof (integer_from_0 _ Hb). unfold exact_sum in *.
    split; [apply Qle_shift_div_l | apply Qle_shift_div_r]; try assumption; nra.
Qed.

Lemma row_value_error va vb D M : is_float va -> is_float vb ->
  Qabs (vb - va) <= D -> Qabs va <= M -> Qabs vb <= M ->
  Qabs (row_value below above qa qb va vb - (va + (vb - va) * (!below * qb / exact_sum))) <= near_bound 6 1 D M.
Proof.
  intros Fa Fb HD Ma Mb. destruct row_share as [A T].
  unfold RoundedModel.row_value. apply (between_error fl R 4); try assumption; try lia. apply hull; assumption.
Qed.

Lemma row_q_weight : weight 4 505 exact_sum (row_q below above height qa qb).
Proof.
  destruct row_sum_weight as [_ S]. pose proof (weight_exact 33 height ltac:(cbn; lia)) as Wh.
  pose proof (integer_from_1 height ltac:(lia)) as P. assert (P0 : 0 < !height) by lra.
  pose proof (weight_div fl R 2 437 0 33 _ _ _ _ ltac:(lia) P0 S Wh) as D.
  pose proof (weight_mul fl R 0 33 3 471 _ _ _ _ ltac:(lia) Wh D) as M.
  assert (E : !height * (exact_sum / !height) == exact_sum) by (field; lra).
  destruct M as [M1 M2 M3 M4]. split; [rewrite <- E; assumption | | assumption |].
  - eapply approx_eq; [exact M2 | exact E | reflexivity].
  - destruct M4 as [Z | M4]; [left; assumption | right]. exact M4.
Qed.
End Edge.

(** Along a row, with l and r the distances to its left and right edge, whole numbers that are rounded to f64. *)
Section Row.
Variables (l r : Z).
Hypothesis (Hl : (0 <= l < 2 ^ 68)%Z) (Hr : (0 < r < 2 ^ 68)%Z).

Notation row_place := (RoundedModel.row_place fl l r).

Lemma row_place_error (sl sr ql qr : Q) : 0 < sl -> 0 < sr -> weight 4 505 sl ql -> weight 4 505 sr qr ->
  Qabs (row_place ql qr - !l * sr / (!r * sl + !l * sr)) <= drift 6 / (2 * low 6) + drift 3 + eta /\
  0 <= row_place ql qr /\ 0 <= !l * sr / (!r * sl + !l * sr) <= 1.
Proof.
  intros Pl Pr Wl Wr.
  pose proof (weight_integer fl R 68 l ltac:(lia) Hl) as Il.
  pose proof (weight_integer fl R 68 r ltac:(lia) ltac:(lia)) as Ir.
  pose proof (weight_mul fl R 1 69 4 505 _ _ _ _ ltac:(lia) Il Wr) as X.
  pose proof (weight_mul fl R 1 69 4 505 _ _ _ _ ltac:(lia) Ir Wl) as Y. cbn [Nat.add] in X, Y.
  pose proof (integer_from_0 l ltac:(lia)) as Hl0. pose proof (integer_from_1 r ltac:(lia)) as Hr1.
  unfold RoundedModel.row_place. set (x := fl (fl !l * qr)) in *. set (y := fl (fl !r * ql)) in *.
  set (x0 := !l * sr) in *. set (y0 := !r * sl) in *.
  assert (Hx0 : 0 <= x0) by (unfold x0; nra). assert (Hy0 : 0 < y0) by (unfold y0; nra).
  (* The rounded weights are exact weights of their own: three roundings more. *)
  assert (Px : 0 <= x) by (destruct (approx_at _ _ _ (w_approx _ _ _ _ X) Hx0); assumption).
  assert (Py : 0 < y).
  { pose proof (weight_positive _ _ _ _ Y Hy0) as [L _]. pose proof (two_at_least_1 575). nra. }
  assert (X' : weight 0 575 x x) by (split; [assumption | apply approx_refl | apply (w_float _ _ _ _ X) | apply (w_sized _ _ _ _ X)]).
  assert (Y' : weight 0 575 y y) by (split; [lra | apply approx_refl | apply (w_float _ _ _ _ Y) | apply (w_sized _ _ _ _ Y)]).
  pose proof (weight_add fl R 0 575 _ _ _ _ ltac:(lia) Y' X') as S.
  pose proof (weight_exact 1 1 ltac:(cbn; lia)) as W. change (!1) with 1 in W.
  assert (Pyx : 0 < y + x) by lra.
  pose proof (w_approx _ _ _ _ (weight_div fl R 0 1 1 577 _ _ _ _ ltac:(lia) Pyx W S)) as I.
  destruct (split_error _ _ (fl_absolute _ R (x * fl (1 / fl (y + x))))) as (p & e & E & Hp & He).
  assert (A : approx 3 (x * (1 / (y + x))) p) by exact (approx_round _ _ _ _ Hp (approx_mul _ _ _ _ _ _ (approx_refl x) I)).
  set (place := fl (x * fl (1 / fl (y + x)))) in *.
  assert (Ex : x * (1 / (y + x)) == x / (x + y)) by (field; lra).
  assert (T : 0 <= x / (x + y) <= 1) by (split; [apply Qle_shift_div_l | apply Qle_shift_div_r]; lra).
  assert (A' : approx 3 (x / (x + y)) p) by (eapply approx_eq; [exact A | exact Ex | reflexivity]).
  destruct (approx_at _ _ _ A' (proj1 T)) as (P0 & _ & _).
  pose proof (approx_error 3 _ _ ltac:(lia) A') as Er. rewrite (Qabs_pos (x / (x + y))) in Er by lra.
  pose proof (share_error 6 _ _ _ _ ltac:(lia) Hx0 Hy0 (w_approx _ _ _ _ X) (w_approx _ _ _ _ Y)) as Sh.
  assert (Ey : x0 / (y0 + x0) == x0 / (x0 + y0)) by (field; lra).
  assert (Hd3 : 0 <= drift 3) by (apply Qle_bool_iff; vm_compute; reflexivity).
  assert (Er' : Qabs (p - x / (x + y)) <= drift 3) by (eapply Qle_trans; [exact Er|]; nra).
  split; [| split].
  - apply abs_le in Er', Sh, He. apply abs_le. rewrite Ey, E.
    set (k := drift 6 / (2 * low 6)) in *. clearbody k. set (h := drift 3) in *. clearbody h. set (g := eta) in *. clearbody g.
    split; lra.
  - (* A rounded product of numbers that are not negative is not below -eta, and a multiple of 2 eta. *)
    apply (fl_sign _ R). apply Qmult_le_0_compat; [assumption|].
    destruct (approx_at _ _ _ I) as (I0 & _ & _); [apply Qle_shift_div_l; lra | exact I0].
  - split; [apply Qle_shift_div_l | apply Qle_shift_div_r]; lra.
Qed.

Notation depth_place := (RoundedModel.depth_place fl l).

Lemma depth_place_error l0 r0 hl hr : (0 <= l0 < 2 ^ 68)%Z -> (0 < r0 < 2 ^ 68)%Z ->
  (0 < hl < 2 ^ 33)%Z -> (0 < hr < 2 ^ 33)%Z -> (l0 * hr + r0 * hl = l * hr + r * hl)%Z ->
  Qabs (depth_place l0 r0 hl hr - !l * !hr / (!l * !hr + !r * !hl)) <= drift 7 /\
  0 <= depth_place l0 r0 hl hr /\ 0 <= !l * !hr / (!l * !hr + !r * !hl) <= 1.
Proof.
  intros Hl0 Hr0 Hhl Hhr Hw.
  pose proof (weight_integer fl R 68 l ltac:(lia) Hl) as Il.
  pose proof (weight_integer fl R 68 l0 ltac:(lia) Hl0) as Il0.
  pose proof (weight_integer fl R 68 r0 ltac:(lia) ltac:(lia)) as Ir0.
  pose proof (weight_exact 33 hr ltac:(cbn; lia)) as Whr. pose proof (weight_exact 33 hl ltac:(cbn; lia)) as Whl.
  pose proof (weight_mul fl R 1 69 0 33 _ _ _ _ ltac:(lia) Il0 Whr) as X.
  pose proof (weight_mul fl R 1 69 0 33 _ _ _ _ ltac:(lia) Ir0 Whl) as Y. cbn [Nat.add] in X, Y.
  pose proof (weight_add fl R 2 103 _ _ _ _ ltac:(lia) X Y) as S. cbn [Nat.add] in S.
  assert (Ew : !l0 * !hr + !r0 * !hl == !l * !hr + !r * !hl).
  { rewrite <- !inject_Z_mult, <- !inject_Z_plus, Hw. reflexivity. }
  pose proof (integer_from_0 l ltac:(lia)). pose proof (integer_from_1 r ltac:(lia)).
  pose proof (integer_from_1 hl ltac:(lia)). pose proof (integer_from_1 hr ltac:(lia)).
  assert (Plr : 0 <= !l * !hr) by nra. assert (Prl : 0 < !r * !hl) by nra.
  assert (Pw : 0 < !l0 * !hr + !r0 * !hl) by (rewrite Ew; lra).
  pose proof (weight_exact 1 1 ltac:(cbn; lia)) as W. change (!1) with 1 in W.
  pose proof (weight_div fl R 0 1 3 105 _ _ _ _ ltac:(lia) Pw W S) as V. cbn [Nat.add] in V.
  pose proof (weight_mul fl R 0 33 4 107 _ _ _ _ ltac:(lia) Whr V) as P. cbn [Nat.add] in P.
  pose proof (weight_mul fl R 1 69 5 141 _ _ _ _ ltac:(lia) Il P) as A. cbn [Nat.add] in A.
  assert (E : !l * (!hr * (1 / (!l0 * !hr + !r0 * !hl))) == !l * !hr / (!l * !hr + !r * !hl)).
  { rewrite Ew. field. lra. }
  assert (T : 0 <= !l * !hr / (!l * !hr + !r * !hl) <= 1).
  { split; [apply Qle_shift_div_l | apply Qle_shift_div_r]; lra. }
  assert (A7 : approx 7 (!l * !hr / (!l * !hr + !r * !hl)) (depth_place l0 r0 hl hr)).
  { eapply approx_eq; [exact (w_approx _ _ _ _ A) | exact E | reflexivity]. }
  destruct (approx_at _ _ _ A7 (proj1 T)) as (P0 & _ & _).
  pose proof (approx_error 7 _ _ ltac:(lia) A7) as Er.
  rewrite (Qabs_pos (!l * !hr / (!l * !hr + !r * !hl))) in Er by apply T.
  split; [| split; assumption]. eapply Qle_trans; [exact Er|].
  assert (0 <= drift 7) by (apply Qle_bool_iff; vm_compute; reflexivity). nra.
Qed.

(** Both ends of the row. *)
Variables (below1 above1 height1 below2 above2 height2 : Z).
Hypothesis (Hb1 : (0 <= below1)%Z) (Ha1 : (0 < above1)%Z) (Hs1 : (below1 + above1 = height1)%Z) (Hh1 : (height1 < 2 ^ 33)%Z).
Hypothesis (Hb2 : (0 <= below2)%Z) (Ha2 : (0 < above2)%Z) (Hs2 : (below2 + above2 = height2)%Z) (Hh2 : (height2 < 2 ^ 33)%Z).

Definition all_within (D M : Q) (values : list Q) : Prop :=
  (forall v w, In v values -> In w values -> Qabs (v - w) <= D) /\
  (forall v, In v values -> is_float v /\ Qabs v <= M).

Lemma between_within va vb t vc vd s D : Qabs (va - vc) <= D -> Qabs (va - vd) <= D -> Qabs (vb - vc) <= D ->
  Qabs (vb - vd) <= D -> 0 <= t <= 1 -> 0 <= s <= 1 ->
  Qabs ((vc + (vd - vc) * s) - (va + (vb - va) * t)) <= D.
Proof.
  intros H1 H2 H3 H4 Ht Hs. apply abs_le in H1, H2, H3, H4. apply abs_le.
  setoid_replace ((vc + (vd - vc) * s) - (va + (vb - va) * t)) with
    ((1 - t) * ((1 - s) * (vc - va) + s * (vd - va)) + t * ((1 - s) * (vc - vb) + s * (vd - vb))) by ring.
  assert (A : - D <= (1 - s) * (vc - va) + s * (vd - va) <= D) by (split; nra).
  assert (B : - D <= (1 - s) * (vc - vb) + s * (vd - vb) <= D) by (split; nra).
  set (a := (1 - s) * (vc - va) + s * (vd - va)) in *. set (b := (1 - s) * (vc - vb) + s * (vd - vb)) in *.
  clearbody a b. split; nra.
Qed.

Notation scanline_depth := (RoundedModel.scanline_depth fl l below1 height1 below2 height2).

Definition exact_scanline_depth (za zb zc zd : Q) : Q :=
  let left := za + (zb - za) * (!below1 / !height1) in
  let right := zc + (zd - zc) * (!below2 / !height2) in
  left + (right - left) * (!l * !height2 / (!l * !height2 + !r * !height1)).

Theorem scanline_depth_error l0 r0 za zb zc zd D M : (0 <= l0 < 2 ^ 68)%Z -> (0 < r0 < 2 ^ 68)%Z ->
  (l0 * height2 + r0 * height1 = l * height2 + r * height1)%Z -> all_within D M [za; zb; zc; zd] ->
  Qabs (scanline_depth l0 r0 za zb zc zd - exact_scanline_depth za zb zc zd) <= bound 12 2 D M.
Proof.
  intros Hl0 Hr0 Hw [HD HM].
  destruct (HM za) as [Fa Ma]; [cbn; tauto|]. destruct (HM zb) as [Fb Mb]; [cbn; tauto|].
  destruct (HM zc) as [Fc Mc]; [cbn; tauto|]. destruct (HM zd) as [Fd Md]; [cbn; tauto|].
  assert (Dab : Qabs (zb - za) <= D) by (apply HD; cbn; tauto).
  assert (Dcd : Qabs (zd - zc) <= D) by (apply HD; cbn; tauto).
  pose proof (row_depth_error below1 above1 height1 Hb1 Ha1 Hs1 Hh1 za zb D M Fa Fb Dab Ma Mb) as Le.
  pose proof (row_depth_error below2 above2 height2 Hb2 Ha2 Hs2 Hh2 zc zd D M Fc Fd Dcd Mc Md) as Re.
  destruct (share_of_integers below1 height1 33 ltac:(lia) ltac:(cbn; lia) ltac:(lia)) as [_ T1].
  destruct (share_of_integers below2 height2 33 ltac:(lia) ltac:(cbn; lia) ltac:(lia)) as [_ T2].
  destruct (depth_place_error l0 r0 height1 height2 Hl0 Hr0 ltac:(lia) ltac:(lia) Hw) as (Es & P0 & T).
  unfold RoundedModel.scanline_depth, exact_scanline_depth. cbv zeta.
  set (vl := za + (zb - za) * (!below1 / !height1)) in *. set (vr := zc + (zd - zc) * (!below2 / !height2)) in *.
  set (s := !l * !height2 / (!l * !height2 + !r * !height1)) in *.
  assert (HDlr : Qabs (vr - vl) <= D).
  { unfold vr, vl. apply between_within; try assumption; apply HD; cbn; tauto. }
  assert (HMv : Qabs (vl + (vr - vl) * s) <= M).
  { apply hull; [assumption | apply hull; assumption | apply hull; assumption]. }
  eapply Qle_trans.
  - assert (G1 : drift 7 <= 1) by (apply Qle_bool_iff; vm_compute; reflexivity).
    exact (across_error fl R _ _ vl vr _ _ s _ D M (fl_float _ R _) (fl_float _ R _) Le Re HDlr T P0 G1 Es HMv).
  - pose proof (Qabs_nonneg (zb - za)). pose proof (Qabs_nonneg za). assert (0 <= D) by lra. assert (0 <= M) by lra.
    pose proof small_tiny as (_ & _ & Hu).
    unfold across_bound, near_bound, bound, drift. change (!(Z.of_nat 2)) with 2.
    change (!(Z.of_nat 7)) with 7. change (!(Z.of_nat 3)) with 3. change (!(Z.of_nat 1)) with 1. change (!(Z.of_nat 12)) with 12.
    set (tiny := 1 # 2 ^ 666) in *. set (h := eta) in *. set (under := underflow) in *.
    assert (Ht : 0 <= tiny) by (apply Qle_bool_iff; vm_compute; reflexivity).
    assert (He : 0 <= h) by (apply Qle_bool_iff; vm_compute; reflexivity).
    assert (Hu2 : 3 * tiny + 2 * h <= under) by (apply Qle_bool_iff; vm_compute; reflexivity).
    clearbody tiny h under. unfold u, second_order, rate. lra.
Qed.

(** The relative 1/w of the four ends as they were computed, and the 1/w themselves. *)
Variables (wa wb wc wd largest : Q).
Hypothesis (Hwa : inv_w wa) (Hwb : inv_w wb) (Hwc : inv_w wc) (Hwd : inv_w wd) (Hlargest : inv_w largest).

Notation relative := (RoundedModel.relative fl largest).

Notation scanline_attribute := (RoundedModel.scanline_attribute fl l r below1 above1 height1 below2 above2 height2 wa wb wc wd largest).

Definition exact_scanline_attribute (va vb vc vd : Q) : Q :=
  mean4 (!r * !above1 * wa) (!r * !below1 * wb) (!l * !above2 * wc) (!l * !below2 * wd) va vb vc vd.

Lemma relative_positive w : inv_w w -> 0 < relative w /\ weight 0 401 (relative w) (relative w) /\
  approx 1 (w / largest) (relative w).
Proof.
  intros Hw. pose proof (relative_weight w largest Hw Hlargest) as W. fold (RoundedModel.relative fl largest w) in W.
  destruct (inv_w_weight _ Hw) as [Pw _]. destruct (inv_w_weight _ Hlargest) as [Pl _].
  assert (P : 0 < w / largest) by (apply Qlt_shift_div_l; lra).
  pose proof (weight_positive _ _ _ _ W P) as [L _]. pose proof (two_at_least_1 401).
  assert (0 < relative w) by nra. split; [assumption|]. split; [| apply (w_approx _ _ _ _ W)].
  split; [lra | apply approx_refl | apply (w_float _ _ _ _ W) | apply (w_sized _ _ _ _ W)].
Qed.

(** Two means of the ends of two edges, and the mean of those: one mean of four. *)
Lemma nested_mean x1 y1 x2 y2 lz rz va vb vc vd : 0 < x1 + y1 -> 0 < x2 + y2 ->
  0 < rz * (x1 + y1) + lz * (x2 + y2) ->
  let left := va + (vb - va) * (y1 / (x1 + y1)) in
  let right := vc + (vd - vc) * (y2 / (x2 + y2)) in
  left + (right - left) * (lz * (x2 + y2) / (rz * (x1 + y1) + lz * (x2 + y2))) ==
  mean4 (rz * x1) (rz * y1) (lz * x2) (lz * y2) va vb vc vd.
Proof.
  intros. unfold left, right, mean4. field. repeat split; lra.
Qed.

Lemma mean_scaled a b c d k va vb vc vd : ~ k == 0 -> ~ a + b + c + d == 0 ->
  mean4 (a / k) (b / k) (c / k) (d / k) va vb vc vd == mean4 a b c d va vb vc vd.
Proof.
  intros Hk Hs. unfold mean4. field. repeat split; try assumption.
Qed.

(** Products on their own, since [nra] takes long among all that is known of a row. *)
Lemma product_not_negative i j w : 0 <= i -> 0 <= j -> 0 <= w -> 0 <= i * j * w.
Proof. intros. apply Qmult_le_0_compat; [apply Qmult_le_0_compat|]; assumption. Qed.

Lemma product_positive i j w : 1 <= i -> 1 <= j -> 0 < w -> 0 < i * j * w.
Proof. intros. apply Qmult_lt_0_compat; [nra | assumption]. Qed.

Lemma scaled_le c p q : 0 <= c -> p <= q -> c * p <= c * q.
Proof. intros. rewrite !(Qmult_comm c). apply Qmult_le_compat_r; assumption. Qed.

Theorem scanline_attribute_error va vb vc vd D M : all_within D M [va; vb; vc; vd] ->
  Qabs (scanline_attribute va vb vc vd - exact_scanline_attribute va vb vc vd) <= bound 15 2 D M.
Proof.
  intros [HD HM].
  destruct (HM va) as [Fa Ma]; [cbn; tauto|]. destruct (HM vb) as [Fb Mb]; [cbn; tauto|].
  destruct (HM vc) as [Fc Mc]; [cbn; tauto|]. destruct (HM vd) as [Fd Md]; [cbn; tauto|].
  assert (Dab : Qabs (vb - va) <= D) by (apply HD; cbn; tauto).
  assert (Dcd : Qabs (vd - vc) <= D) by (apply HD; cbn; tauto).
  destruct (relative_positive wa Hwa) as (Pa & Wa & Aa). destruct (relative_positive wb Hwb) as (Pb & Wb & Ab).
  destruct (relative_positive wc Hwc) as (Pc & Wc & Ac). destruct (relative_positive wd Hwd) as (Pd & Wd & Ad).
  unfold RoundedModel.scanline_attribute.
  set (qa := relative wa) in *. set (qb := relative wb) in *. set (qc := relative wc) in *. set (qd := relative wd) in *.
  pose proof (row_value_error below1 above1 height1 Hb1 Ha1 Hs1 Hh1 qa qb Wa Wb Pa Pb va vb D M Fa Fb Dab Ma Mb) as Le.
  pose proof (row_value_error below2 above2 height2 Hb2 Ha2 Hs2 Hh2 qc qd Wc Wd Pc Pd vc vd D M Fc Fd Dcd Mc Md) as Re.
  destruct (row_share below1 above1 height1 Hb1 Ha1 Hs1 Hh1 qa qb Wa Wb Pa Pb) as [_ T1].
  destruct (row_share below2 above2 height2 Hb2 Ha2 Hs2 Hh2 qc qd Wc Wd Pc Pd) as [_ T2].
  pose proof (row_q_weight below1 above1 height1 Hb1 Ha1 Hs1 Hh1 qa qb Wa Wb) as Wl.
  pose proof (row_q_weight below2 above2 height2 Hb2 Ha2 Hs2 Hh2 qc qd Wc Wd) as Wr.
  pose proof (exact_sum_positive below1 above1 Hb1 Ha1 qa qb Pa Pb) as S1.
  pose proof (exact_sum_positive below2 above2 Hb2 Ha2 qc qd Pc Pd) as S2.
  destruct (row_place_error _ _ _ _ S1 S2 Wl Wr) as (Es & P0 & T).
  unfold exact_sum in *.
  set (x1 := !above1 * qa) in *. set (y1 := !below1 * qb) in *.
  set (x2 := !above2 * qc) in *. set (y2 := !below2 * qd) in *.
  set (vl := va + (vb - va) * (y1 / (x1 + y1))) in *. set (vr := vc + (vd - vc) * (y2 / (x2 + y2))) in *.
  set (s := !l * (x2 + y2) / (!r * (x1 + y1) + !l * (x2 + y2))) in *.
  assert (HDlr : Qabs (vr - vl) <= D).
  { unfold vr, vl. apply between_within; try assumption; apply HD; cbn; tauto. }
  assert (HMv : Qabs (vl + (vr - vl) * s) <= M).
  { apply hull; [assumption | apply hull; assumption | apply hull; assumption]. }
  pose proof (integer_from_0 l ltac:(lia)) as Nl. pose proof (integer_from_1 r ltac:(lia)) as Nr.
  pose proof (integer_from_0 below1 Hb1) as B1. pose proof (integer_from_0 below2 Hb2) as B2.
  pose proof (integer_from_1 above1 Ha1) as A1. pose proof (integer_from_1 above2 Ha2) as A2.
  assert (Nr0 : 0 <= !r) by lra. assert (A20 : 0 <= !above2) by lra. assert (A10 : 0 <= !above1) by lra.
  assert (Pw : 0 < !r * (x1 + y1) + !l * (x2 + y2)).
  { assert (0 < !r * (x1 + y1)) by (apply Qmult_lt_0_compat; lra).
    assert (0 <= !l * (x2 + y2)) by (apply Qmult_le_0_compat; lra). lra. }
  pose proof (nested_mean x1 y1 x2 y2 !l !r va vb vc vd S1 S2 Pw) as Nest. cbv zeta in Nest.
  fold vl vr s in Nest.
  (* The exact mean, with 1/w relative to the largest. *)
  destruct (inv_w_weight _ Hwa) as [Qa _]. destruct (inv_w_weight _ Hwb) as [Qb _].
  destruct (inv_w_weight _ Hwc) as [Qc _]. destruct (inv_w_weight _ Hwd) as [Qd _].
  destruct (inv_w_weight _ Hlargest) as [QL _].
  assert (NN : forall w, 0 < w -> 0 <= w / largest) by (intros; apply Qle_shift_div_l; lra).
  assert (Scaled : exact_scanline_attribute va vb vc vd ==
    mean4 (!r * !above1 * (wa / largest)) (!r * !below1 * (wb / largest))
          (!l * !above2 * (wc / largest)) (!l * !below2 * (wd / largest)) va vb vc vd).
  { unfold exact_scanline_attribute. rewrite <- (mean_scaled _ _ _ _ largest).
    - unfold mean4, Qdiv. rewrite !Qmult_assoc. reflexivity.
    - lra.
    - pose proof (product_positive _ _ _ Nr A1 Qa).
      pose proof (product_not_negative _ _ _ Nr0 B1 (Qlt_le_weak _ _ Qb)).
      pose proof (product_not_negative _ _ _ Nl A20 (Qlt_le_weak _ _ Qc)).
      pose proof (product_not_negative _ _ _ Nl B2 (Qlt_le_weak _ _ Qd)). lra. }
  assert (Mean : Qabs (mean4 (!r * x1) (!r * y1) (!l * x2) (!l * y2) va vb vc vd -
    mean4 (!r * !above1 * (wa / largest)) (!r * !below1 * (wb / largest))
          (!l * !above2 * (wc / largest)) (!l * !below2 * (wd / largest)) va vb vc vd) <= drift 1 / low 1 * D).
  { assert (K : forall i j w q, 0 <= i -> 0 <= j -> approx 1 w q -> approx 1 (i * j * w) (i * (j * q))).
    { intros i j w q _ _ A. eapply approx_eq; [exact (approx_mul 0 1 _ _ _ _ (approx_refl (i * j)) A) | reflexivity | ring]. }
    apply mean_error; try (apply K; try assumption; lra); try assumption.
    - exact (product_not_negative _ _ _ Nr0 A10 (NN _ Qa)).
    - exact (product_not_negative _ _ _ Nr0 B1 (NN _ Qb)).
    - exact (product_not_negative _ _ _ Nl A20 (NN _ Qc)).
    - exact (product_not_negative _ _ _ Nl B2 (NN _ Qd)).
    - assert (Pos : 0 < wa / largest) by (apply Qlt_shift_div_l; lra).
      pose proof (product_positive _ _ _ Nr A1 Pos).
      pose proof (product_not_negative _ _ _ Nr0 B1 (NN _ Qb)).
      pose proof (product_not_negative _ _ _ Nl A20 (NN _ Qc)).
      pose proof (product_not_negative _ _ _ Nl B2 (NN _ Qd)). lra. }
  rewrite <- Scaled, <- Nest in Mean.
  assert (Across : Qabs (RoundedModel.between fl (row_value below1 above1 qa qb va vb) (row_value below2 above2 qc qd vc vd)
      (row_place (row_q below1 above1 height1 qa qb) (row_q below2 above2 height2 qc qd)) - (vl + (vr - vl) * s))
    <= across_bound (near_bound 6 1 D M) (drift 6 / (2 * low 6) + drift 3 + eta) D M).
  { assert (G1 : drift 6 / (2 * low 6) + drift 3 + eta <= 1) by (apply Qle_bool_iff; vm_compute; reflexivity).
    exact (across_error fl R _ _ vl vr _ _ s _ D M (fl_float _ R _) (fl_float _ R _) Le Re HDlr T P0 G1 Es HMv). }
  set (z := RoundedModel.between fl _ _ _) in *. set (v := exact_scanline_attribute va vb vc vd) in *. clearbody z v.
  assert (Sharp : drift 6 / (2 * low 6) + drift 3 + eta <= 6 * u * (1 + (1 # 2199023255552))).
  { apply Qle_bool_iff. vm_compute. reflexivity. }
  assert (Sharp1 : drift 1 / low 1 <= u * (1 + (1 # 2199023255552))) by (apply Qle_bool_iff; vm_compute; reflexivity).
  set (g := drift 6 / (2 * low 6) + drift 3 + eta) in *. set (k := drift 1 / low 1) in *.
  assert (Hg0 : 0 <= g) by (apply Qle_bool_iff; vm_compute; reflexivity).
  pose proof (Qabs_nonneg (vb - va)). pose proof (Qabs_nonneg va). assert (HD0 : 0 <= D) by lra. assert (HM0 : 0 <= M) by lra.
  assert (Wide : across_bound (near_bound 6 1 D M) g D M <=
    across_bound (near_bound 6 1 D M) (6 * u * (1 + (1 # 2199023255552))) D M).
  { unfold across_bound. assert (0 <= D + 2 * near_bound 6 1 D M).
    { unfold near_bound. change (!(Z.of_nat 6)) with 6. change (!(Z.of_nat 1)) with 1.
      assert (0 <= 1 # 2 ^ 666) by (apply Qle_bool_iff; vm_compute; reflexivity).
      set (tiny := 1 # 2 ^ 666) in *. clearbody tiny. unfold u. lra. }
    set (w := D + 2 * near_bound 6 1 D M) in *. set (big := 6 * u * (1 + (1 # 2199023255552))) in *.
    pose proof (scaled_le w g big ltac:(assumption) Sharp).
    assert (Hd2 : 0 <= drift 2) by (apply Qle_bool_iff; vm_compute; reflexivity).
    pose proof (scaled_le (drift 2) (w * (1 + g)) (w * (1 + big)) Hd2 ltac:(apply scaled_le; [assumption | lra])).
    set (e := near_bound 6 1 D M) in *. set (p := w * g) in *. set (p' := w * big) in *.
    set (q := drift 2 * (w * (1 + g))) in *. set (q' := drift 2 * (w * (1 + big))) in *. set (h := eta) in *.
    clearbody e p p' q q' h. unfold u. lra. }
  assert (Kd : k * D <= u * (1 + (1 # 2199023255552)) * D) by (apply Qmult_le_compat_r; assumption).
  apply abs_le in Across, Mean. apply abs_le.
  assert (Final : across_bound (near_bound 6 1 D M) (6 * u * (1 + (1 # 2199023255552))) D M +
    u * (1 + (1 # 2199023255552)) * D <= bound 15 2 D M).
  { pose proof small_tiny as (_ & _ & Hu).
    unfold across_bound, near_bound, bound, drift. change (!(Z.of_nat 2)) with 2.
    change (!(Z.of_nat 6)) with 6. change (!(Z.of_nat 1)) with 1. change (!(Z.of_nat 15)) with 15.
    set (tiny := 1 # 2 ^ 666) in *. set (h := eta) in *. set (under := underflow) in *.
    assert (Ht : 0 <= tiny) by (apply Qle_bool_iff; vm_compute; reflexivity).
    assert (He : 0 <= h) by (apply Qle_bool_iff; vm_compute; reflexivity).
    assert (Hu2 : 3 * tiny + 2 * h <= under) by (apply Qle_bool_iff; vm_compute; reflexivity).
    clearbody tiny h under. unfold u, second_order, rate. lra. }
  set (bd := bound 15 2 D M) in *. clearbody bd.
  set (ab := across_bound (near_bound 6 1 D M) g D M) in *. set (ac := across_bound _ _ D M) in *.
  clearbody ab ac. set (kD := k * D) in *. clearbody kD. split; lra.
Qed.
End Row.
End Engines.
