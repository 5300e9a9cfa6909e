(** The forms that both engines compute values in, and what rounding makes of each. *)
From Coq Require Import ZArith QArith Qabs Lia Lqa Bool Arith List.
From Rasterproof Require RoundedModel.
From Rasterproof Require Import Rounding.
Import ListNotations.
Open Scope Q_scope.

(** What the bounds leave for products of errors, and for what falls below the normal numbers. *)
Definition second_order : Q := Eval compute in 1 + (1 # (2 ^ 40)).
Definition underflow : Q := Eval compute in 1 # (2 ^ 660).
Definition bound (d m : nat) (D M : Q) : Q :=
  u * (inject_Z (Z.of_nat d) * D + inject_Z (Z.of_nat m) * M) * second_order + underflow.


(** The same with less to spare, for a value that others are computed from. *)
Definition near_bound (d m : nat) (D M : Q) : Q :=
  u * (inject_Z (Z.of_nat d) * D + inject_Z (Z.of_nat m) * M) * (1 + (1 # 8796093022208)) + (1 # 2 ^ 666).

Section Forms.
Variable fl : Q -> Q.
Hypothesis R : rounds fl.

Notation offset := (RoundedModel.offset fl).

(** One term: the weight, the difference and the product are rounded. *)
Lemma term n v0 v b a : is_float v0 -> is_float v -> approx n b a ->
  exists t e, fl (fl (v - v0) * a) == t + e /\ approx (n + 2) ((v - v0) * b) t /\ Qabs e <= eta.
Proof.
  intros F0 F A.
  assert (Ad : approx 1 (v - v0) (fl (v - v0))).
  { eapply approx_round; [apply (fl_difference _ R); assumption | apply approx_refl]. }
  pose proof (approx_mul _ _ _ _ _ _ Ad A) as Ap.
  destruct (split_error _ _ (fl_absolute _ R (fl (v - v0) * a))) as (t & e & E & Ht & He).
  exists t, e. split; [assumption|]. split; [|assumption].
  replace (n + 2)%nat with (S (1 + n)) by lia. exact (approx_round _ _ _ _ Ht Ap).
Qed.
(** 2^405: no reciprocal of a sum of weights is larger; and what products below the normal numbers make of it. *)
Definition largest_inverse : Q := Eval compute in inject_Z (2 ^ 405).
Definition small : Q := Eval compute in 1 # (2 ^ 667).

Lemma abs_le x b : Qabs x <= b <-> - b <= x <= b.
Proof. apply Qabs_Qle_condition. Qed.

Lemma abs_mul_le x y a b : Qabs x <= a -> Qabs y <= b -> Qabs (x * y) <= a * b.
Proof.
  intros. rewrite Qabs_Qmult. pose proof (Qabs_nonneg x). pose proof (Qabs_nonneg y). nra.
Qed.

Theorem offset_error n m v0 v1 v2 b1 b2 s a1 a2 r D M :
  (n + m + 4 <= 20)%nat -> is_float v0 -> is_float v1 -> is_float v2 ->
  0 <= b1 -> 0 <= b2 -> 0 < s -> b1 + b2 <= s ->
  approx n b1 a1 -> approx n b2 a2 -> approx m (/ s) r -> 0 <= r <= largest_inverse ->
  Qabs (v1 - v0) <= D -> Qabs (v2 - v0) <= D ->
  Qabs (v0 + ((v1 - v0) * b1 + (v2 - v0) * b2) / s) <= M ->
  Qabs (offset v0 v1 v2 a1 a2 r - (v0 + ((v1 - v0) * b1 + (v2 - v0) * b2) / s)) <= bound (n + m + 4) 1 D M.
Proof.
  intros Hnm F0 F1 F2 Hb1 Hb2 Hs Hb A1 A2 Ar Hr HD1 HD2 HM.
  destruct (term n v0 v1 b1 a1 F0 F1 A1) as (t1 & e1 & E1 & T1 & He1).
  destruct (term n v0 v2 b2 a2 F0 F2 A2) as (t2 & e2 & E2 & T2 & He2).
  unfold RoundedModel.offset.
  set (f1 := fl (fl (v1 - v0) * a1)) in *. set (f2 := fl (fl (v2 - v0) * a2)) in *.
  assert (G1 : is_float f1) by apply (fl_float _ R). assert (G2 : is_float f2) by apply (fl_float _ R).
  destruct (rounding_factor _ _ (fl_sum _ R f1 f2 G1 G2)) as (d & Z & Hd).
  set (sum := fl (f1 + f2)) in *.
  destruct (split_error _ _ (fl_absolute _ R (sum * r))) as (y & e3 & Y & Hy & He3).
  destruct (rounding_factor _ _ Hy) as (d' & Z' & Hd').
  assert (G3 : is_float (fl (sum * r))) by apply (fl_float _ R).
  set (X := fl (sum * r)) in *.
  pose proof (fl_sum _ R v0 X F0 G3) as Hfin. set (v := fl (v0 + X)) in *. clearbody v X sum f1 f2.
  (* The two terms as factors of the exact ones. *)
  pose proof (approx_factor _ _ _ _ Hd' (approx_factor _ _ _ _ Hd (approx_mul _ _ _ _ _ _ T1 Ar))) as C1.
  pose proof (approx_factor _ _ _ _ Hd' (approx_factor _ _ _ _ Hd (approx_mul _ _ _ _ _ _ T2 Ar))) as C2.
  replace (S (S (n + 2 + m))) with (n + m + 4)%nat in C1, C2 by lia.
  set (c1 := t1 * r * (1 + d) * (1 + d')) in *. set (c2 := t2 * r * (1 + d) * (1 + d')) in *.
  pose proof (approx_error _ _ _ Hnm C1) as B1. pose proof (approx_error _ _ _ Hnm C2) as B2.
  assert (EX : X == c1 + c2 + ((e1 + e2) * ((1 + d) * (1 + d')) * r + e3)).
  { rewrite Y, Z', Z, E1, E2. unfold c1, c2. ring. }
  assert (Hrest : Qabs ((e1 + e2) * ((1 + d) * (1 + d')) * r + e3) <= small).
  { apply abs_le in He1, He2, He3.
    assert (P1 : Qabs (e1 + e2) <= 2 * eta) by (apply abs_le; lra).
    assert (P2 : Qabs ((1 + d) * (1 + d')) <= 2).
    { apply abs_le. unfold u in *. split; nra. }
    assert (P3 : Qabs r <= largest_inverse) by (apply abs_le; lra).
    pose proof (abs_mul_le _ _ _ _ (abs_mul_le _ _ _ _ P1 P2) P3) as P4. apply abs_le in P4.
    assert (2 * eta * 2 * largest_inverse + eta <= small) by (apply Qle_bool_iff; vm_compute; reflexivity).
    apply abs_le. split; lra. }
  set (rest := (e1 + e2) * ((1 + d) * (1 + d')) * r + e3) in *. clearbody c1 c2 rest.
  (* The exact terms are at most D together. *)
  set (x1 := (v1 - v0) * b1 * / s) in *. set (x2 := (v2 - v0) * b2 * / s) in *.
  assert (Hsi : 0 < / s) by (apply Qinv_lt_0_compat; assumption).
  assert (HDb : Qabs x1 + Qabs x2 <= D).
  { unfold x1, x2. rewrite !Qabs_Qmult.
    rewrite (Qabs_pos b1), (Qabs_pos b2), (Qabs_pos (/ s)) by lra.
    assert (S1 : s * / s == 1) by (apply Qmult_inv_r; lra).
    assert (HD : 0 <= D) by (pose proof (Qabs_nonneg (v1 - v0)); lra).
    assert (Qabs (v1 - v0) * b1 <= D * b1) by (apply Qmult_le_compat_r; assumption).
    assert (Qabs (v2 - v0) * b2 <= D * b2) by (apply Qmult_le_compat_r; assumption).
    assert (D * (b1 + b2) <= D * s) by nra.
    assert (L : (Qabs (v1 - v0) * b1 + Qabs (v2 - v0) * b2) * / s <= D * s * / s)
      by (apply Qmult_le_compat_r; lra).
    setoid_replace (D * s * / s) with (D * (s * / s)) in L by ring. rewrite S1 in L.
    setoid_replace (Qabs (v1 - v0) * b1 * / s + Qabs (v2 - v0) * b2 * / s)
      with ((Qabs (v1 - v0) * b1 + Qabs (v2 - v0) * b2) * / s) by ring. lra. }
  assert (EV : v0 + ((v1 - v0) * b1 + (v2 - v0) * b2) / s == v0 + (x1 + x2)) by (unfold x1, x2; field; lra).
  rewrite EV in *. clearbody x1 x2. clear EV.
  assert (Hdr : 0 <= drift (n + m + 4)).
  { unfold drift. assert (0 <= inject_Z (Z.of_nat (n + m + 4))) by (change 0 with (inject_Z 0); rewrite <- Zle_Qle; lia). unfold rate. lra. }
  assert (Hx : drift (n + m + 4) * Qabs x1 + drift (n + m + 4) * Qabs x2 <= drift (n + m + 4) * D).
  { setoid_replace (drift (n + m + 4) * Qabs x1 + drift (n + m + 4) * Qabs x2)
      with (drift (n + m + 4) * (Qabs x1 + Qabs x2)) by ring. nra. }
  apply abs_le in B1, B2, Hrest, HM.
  set (g := drift (n + m + 4) * D) in *.
  assert (Hvx : Qabs (v0 + X) <= M + g + small) by (apply abs_le; rewrite EX; lra).
  assert (Hu : u * Qabs (v0 + X) <= u * (M + g + small)) by (unfold u; lra).
  apply abs_le in Hfin. apply abs_le.
  assert (Hk : 0 <= inject_Z (Z.of_nat (n + m + 4))) by (change 0 with (inject_Z 0); rewrite <- Zle_Qle; lia).
  assert (HD : 0 <= D) by (pose proof (Qabs_nonneg (v1 - v0)); lra).
  assert (HM0 : 0 <= M) by lra.
  assert (Hsm : small + u * small <= underflow) by (apply Qle_bool_iff; vm_compute; reflexivity).
  assert (Hfinal : g + u * (M + g) <= bound (n + m + 4) 1 D M - underflow).
  { unfold g, drift, bound. set (k := inject_Z (Z.of_nat (n + m + 4))) in *.
    change (inject_Z (Z.of_nat 1)) with 1.
    assert (HkD : 0 <= k * D) by nra.
    setoid_replace (k * rate * D) with (k * D * rate) by ring. set (kD := k * D) in *. clearbody kD.
    unfold u, second_order, rate in *. lra. }
  split; lra.
Qed.

Notation between := (RoundedModel.between fl).

Lemma small_tiny : 0 <= eta /\ 4 * eta <= (1 # 2 ^ 666) /\ 2 * (1 # 2 ^ 666) + 4 * eta <= underflow.
Proof. repeat split; apply Qle_bool_iff; vm_compute; reflexivity. Qed.

(** What is added to v, with t as it was computed: the difference, the product. *)
Lemma added v w t : is_float v -> is_float w -> 0 <= t <= 2 ->
  Qabs (fl (fl (w - v) * t) - (w - v) * t) <= drift 2 * (Qabs (w - v) * t) + eta.
Proof.
  intros Fv Fw Ht.
  destruct (rounding_factor _ _ (fl_difference _ R w v Fw Fv)) as (d & Z & Hd).
  destruct (split_error _ _ (fl_absolute _ R (fl (w - v) * t))) as (y & e & Y & Hy & He).
  destruct (rounding_factor _ _ Hy) as (d' & Z' & Hd').
  pose proof (approx_factor _ _ _ _ Hd' (approx_factor _ _ _ _ Hd (approx_refl ((w - v) * t)))) as C.
  assert (L : (2 <= 20)%nat) by lia. pose proof (approx_error _ _ _ L C) as B.
  rewrite Qabs_Qmult, (Qabs_pos t) in B by lra.
  assert (E : fl (fl (w - v) * t) - (w - v) * t ==
    ((w - v) * t * (1 + d) * (1 + d') - (w - v) * t) + e) by (rewrite Y, Z', Z; ring).
  rewrite E. apply abs_le in B, He. apply abs_le. lra.
Qed.

Theorem between_error n v w t t' D M : (n + 2 <= 20)%nat -> is_float v -> is_float w ->
  0 <= t <= 1 -> approx n t t' -> Qabs (w - v) <= D -> Qabs (v + (w - v) * t) <= M ->
  Qabs (between v w t' - (v + (w - v) * t)) <= near_bound (n + 2) 1 D M.
Proof.
  intros Hn Fv Fw Ht A HD HM. unfold RoundedModel.between.
  destruct (approx_at _ _ _ A (proj1 Ht)) as (T0 & _ & T1). assert (Hn' : (n <= 20)%nat) by lia.
  pose proof (approx_error _ _ _ Hn' A) as Et. rewrite (Qabs_pos t) in Et by lra.
  destruct (low_drift n Hn') as [_ Lo].
  assert (Hk : 0 <= inject_Z (Z.of_nat n) <= 20).
  { change 0 with (inject_Z 0). change 20 with (inject_Z 20). rewrite <- !Zle_Qle. lia. }
  assert (Hdn : 0 <= drift n <= 20 * rate) by (unfold drift, rate in *; lra).
  assert (T2 : t' <= 2). { unfold rate in Hdn. nra. }
  assert (Ht' : 0 <= t' <= 2) by lra. pose proof (added v w t' Fv Fw Ht') as Ad.
  assert (FX : is_float (fl (fl (w - v) * t'))) by apply (fl_float _ R).
  set (X := fl (fl (w - v) * t')) in *.
  pose proof (fl_sum _ R v X Fv FX) as Hfin. set (z := fl (v + X)) in *. clearbody z X.
  pose proof (Qabs_nonneg (w - v)) as Hd0. assert (HD0 : 0 <= D) by lra.
  assert (Hmul : Qabs ((w - v) * (t' - t)) <= D * drift n).
  { assert (H1 : Qabs (t' - t) <= drift n) by nra.
    exact (abs_mul_le _ _ _ _ HD H1). }
  assert (Hadd : drift 2 * (Qabs (w - v) * t') <= drift 2 * (D * (1 + drift n))).
  { apply abs_le in Et. assert (t' <= 1 + drift n) by nra.
    assert (Qabs (w - v) * t' <= D * (1 + drift n)) by nra.
    assert (0 <= drift 2) by (unfold drift, rate; change (inject_Z (Z.of_nat 2)) with 2; lra). nra. }
  assert (EX : X == (w - v) * t + ((w - v) * (t' - t)) + (X - (w - v) * t')) by ring.
  pose proof small_tiny as (S0 & S1 & _).
  apply abs_le in Hmul, Ad, HM.
  set (g := D * drift n + drift 2 * (D * (1 + drift n)) + eta) in *.
  assert (Hg : - g <= X - (w - v) * t <= g) by (unfold g; lra).
  assert (Hvx : Qabs (v + X) <= M + g) by (apply abs_le; lra).
  assert (Hu : u * Qabs (v + X) <= u * (M + g)) by (unfold u; lra).
  apply abs_le in Hfin. apply abs_le.
  assert (Hfinal : g + u * (M + g) <= near_bound (n + 2) 1 D M).
  { unfold g, near_bound. rewrite Nat2Z.inj_add, inject_Z_plus. change (inject_Z (Z.of_nat 2)) with 2.
    change (inject_Z (Z.of_nat 1)) with 1. unfold drift in *. change (inject_Z (Z.of_nat 2)) with 2 in *.
    set (k := inject_Z (Z.of_nat n)) in *. clearbody k.
    assert (HkD : 0 <= k * D <= 20 * D) by nra.
    setoid_replace (D * (k * rate) + 2 * rate * (D * (1 + k * rate)) + eta) with
      ((k * D) * (rate + 2 * rate * rate) + 2 * rate * D + eta) by ring.
    setoid_replace (u * ((k + 2) * D + 1 * M)) with (u * (k * D) + u * (2 * D) + u * M) by ring.
    set (kD := k * D) in *. clearbody kD.
    assert (HM0 : 0 <= M) by lra. set (tiny := 1 # 2 ^ 666) in *. clearbody tiny. clearbody g.
    set (h := eta) in *. clearbody h. unfold u, rate in *. lra. }
  split; lra.
Qed.

(** The same between two ends that are off by e, at a place that is off by g. *)
Definition across_bound (e g D M : Q) : Q :=
  let off := e + (D + 2 * e) * g + drift 2 * ((D + 2 * e) * (1 + g)) + eta in off + u * (M + off).

Theorem across_error e g v w v' w' s s' D M : is_float v' -> is_float w' ->
  Qabs (v' - v) <= e -> Qabs (w' - w) <= e -> Qabs (w - v) <= D -> 0 <= s <= 1 -> 0 <= s' -> g <= 1 ->
  Qabs (s' - s) <= g -> Qabs (v + (w - v) * s) <= M ->
  Qabs (between v' w' s' - (v + (w - v) * s)) <= across_bound e g D M.
Proof.
  intros Fv Fw Hv Hw HD Hs Hs0 Hg1 Hg HM. unfold RoundedModel.between.
  pose proof (proj1 (abs_le _ _) Hg) as Hg'. assert (Hs' : 0 <= s' <= 2) by lra.
  pose proof (added v' w' s' Fv Fw Hs') as Ad.
  assert (FX : is_float (fl (fl (w' - v') * s'))) by apply (fl_float _ R).
  set (X := fl (fl (w' - v') * s')) in *.
  pose proof (fl_sum _ R v' X Fv FX) as Hfin. set (z := fl (v' + X)) in *. clearbody z X.
  pose proof (Qabs_nonneg (s' - s)). pose proof (Qabs_nonneg (w' - v')) as Hd0.
  apply abs_le in Hv, Hw, HM. pose proof (proj1 (abs_le _ _) HD) as HD'.
  assert (Hdw : Qabs (w' - v') <= D + 2 * e) by (apply abs_le; lra).
  assert (Hmul : Qabs ((w' - v') * (s' - s)) <= (D + 2 * e) * g) by exact (abs_mul_le _ _ _ _ Hdw Hg).
  assert (Hadd : drift 2 * (Qabs (w' - v') * s') <= drift 2 * ((D + 2 * e) * (1 + g))).
  { assert (Qabs (w' - v') * s' <= (D + 2 * e) * (1 + g)) by nra.
    assert (0 <= drift 2) by (unfold drift, rate; change (inject_Z (Z.of_nat 2)) with 2; lra). nra. }
  set (off := e + (D + 2 * e) * g + drift 2 * ((D + 2 * e) * (1 + g)) + eta) in *.
  assert (EX : v' + X - (v + (w - v) * s) ==
    (1 - s) * (v' - v) + s * (w' - w) + (w' - v') * (s' - s) + (X - (w' - v') * s')) by ring.
  assert (Hends : - e <= (1 - s) * (v' - v) + s * (w' - w) <= e) by (split; nra).
  apply abs_le in Hmul, Ad.
  assert (Hoff : - off <= v' + X - (v + (w - v) * s) <= off) by (rewrite EX; unfold off; lra).
  assert (Hvx : Qabs (v' + X) <= M + off) by (apply abs_le; lra).
  assert (Hu : u * Qabs (v' + X) <= u * (M + off)) by (unfold u; lra).
  apply abs_le in Hfin. apply abs_le. unfold across_bound. fold off. split; lra.
Qed.
End Forms.

(** Where two weights are off by n roundings each, the share of one in both moves by half as much: what makes one
    larger makes both larger. *)
Theorem share_error n x y x' y' : (n <= 20)%nat -> 0 <= x -> 0 < y -> approx n x x' -> approx n y y' ->
  Qabs (x' / (x' + y') - x / (x + y)) <= drift n / (2 * low n).
Proof.
  intros Hn Hx Hy (p & E & L & H) (q & F & K & G). pose proof (low_bounds n).
  pose proof (factor_drift n p Hn L H) as Hp. pose proof (factor_drift n q Hn K G) as Hq.
  assert (Hs : 0 < x + y) by lra. assert (Hs' : 0 < x * p + y * q) by nra.
  rewrite E, F.
  assert (D : x * p / (x * p + y * q) - x / (x + y) == x * y * (p - q) / ((x * p + y * q) * (x + y)))
    by (field; split; lra).
  rewrite D. clear D E F x' y'.
  assert (Hd : 0 <= drift n) by lra.
  assert (Hpos : 0 < (x * p + y * q) * (x + y)) by nra.
  assert (Hbig : low n * (x + y) * (x + y) <= (x * p + y * q) * (x + y)).
  { assert (low n * (x + y) <= x * p + y * q) by nra. nra. }
  assert (Hxy : 4 * (x * y) <= (x + y) * (x + y)).
  { assert (0 <= (x - y) * (x - y)) by (destruct (Qlt_le_dec (x - y) 0); nra). lra. }
  assert (Hxy0 : 0 <= x * y) by nra.
  set (b := drift n / (2 * low n)).
  assert (Eb : b * (2 * low n) == drift n) by (unfold b; field; lra).
  assert (Hb : 0 <= b) by (unfold b; apply Qle_shift_div_l; lra).
  assert (Hc : 2 * drift n * (x * y) <= b * ((x * p + y * q) * (x + y))).
  { assert (b * (low n * (x + y) * (x + y)) <= b * ((x * p + y * q) * (x + y))) by nra.
    setoid_replace (b * (low n * (x + y) * (x + y))) with (b * (2 * low n) * ((x + y) * (x + y)) * (1 # 2)) in H1 by ring.
    rewrite Eb in H1. assert (drift n * (4 * (x * y)) <= drift n * ((x + y) * (x + y))) by nra. lra. }
  assert (Hpq : - (2 * drift n) <= p - q <= 2 * drift n) by lra.
  apply Qabs_Qle_condition. split.
  - apply Qle_shift_div_l; [assumption|]. nra.
  - apply Qle_shift_div_r; [assumption|]. nra.
Qed.

(** A weighted mean moves by at most one rounding of the spread where each weight is off by one rounding. *)
Definition mean4 (a b c d va vb vc vd : Q) : Q := (a * va + b * vb + c * vc + d * vd) / (a + b + c + d).

Lemma mean_error a b c d a' b' c' d' va vb vc vd D : 0 <= a -> 0 <= b -> 0 <= c -> 0 <= d -> 0 < a + b + c + d ->
  approx 1 a a' -> approx 1 b b' -> approx 1 c c' -> approx 1 d d' ->
  (forall v w, In v [va; vb; vc; vd] -> In w [va; vb; vc; vd] -> Qabs (v - w) <= D) ->
  Qabs (mean4 a' b' c' d' va vb vc vd - mean4 a b c d va vb vc vd) <= drift 1 / low 1 * D.
Proof.
  intros Ha Hb Hc Hd Hs (p & E & L & H) (q & F & K & G) (r & I & N & J) (t & O & P & Q') HD.
  pose proof (low_bounds 1) as Hl.
  assert (H1 : (1 <= 20)%nat) by lia.
  pose proof (factor_drift 1 p H1 L H) as Fp. pose proof (factor_drift 1 q H1 K G) as Fq.
  pose proof (factor_drift 1 r H1 N J) as Fr. pose proof (factor_drift 1 t H1 P Q') as Ft.
  unfold mean4. rewrite E, F, I, O. clear E F I O a' b' c' d'.
  set (s := a + b + c + d) in *.
  set (m := (a * va + b * vb + c * vc + d * vd) / s).
  assert (Em : m * s == a * va + b * vb + c * vc + d * vd) by (unfold m; field; lra).
  assert (Hs' : low 1 * s <= a * p + b * q + c * r + d * t) by (unfold s; nra).
  assert (Hs0 : 0 < a * p + b * q + c * r + d * t) by nra.
  (* Every value is within D of the mean. *)
  assert (Hnear : forall v, In v [va; vb; vc; vd] -> - D <= v - m <= D).
  { intros v Hv.
    assert (A1 : Qabs (v - va) <= D) by (apply HD; [assumption | cbn; tauto]).
    assert (A2 : Qabs (v - vb) <= D) by (apply HD; [assumption | cbn; tauto]).
    assert (A3 : Qabs (v - vc) <= D) by (apply HD; [assumption | cbn; tauto]).
    assert (A4 : Qabs (v - vd) <= D) by (apply HD; [assumption | cbn; tauto]).
    apply Qabs_Qle_condition in A1, A2, A3, A4.
    assert (Ev : (v - m) * s == a * (v - va) + b * (v - vb) + c * (v - vc) + d * (v - vd)).
    { setoid_replace ((v - m) * s) with (v * s - m * s) by ring. rewrite Em. unfold s. ring. }
    assert (B : - D * s <= (v - m) * s <= D * s) by (rewrite Ev; unfold s; split; nra).
    split; nra. }
  assert (Na : - D <= va - m <= D) by (apply Hnear; cbn; tauto).
  assert (Nb : - D <= vb - m <= D) by (apply Hnear; cbn; tauto).
  assert (Nc : - D <= vc - m <= D) by (apply Hnear; cbn; tauto).
  assert (Nd : - D <= vd - m <= D) by (apply Hnear; cbn; tauto).
  set (g := drift 1) in *. assert (Hg : 0 <= g) by lra. assert (HD0 : 0 <= D) by lra.
  assert (prod : forall w f v, 0 <= w -> - g <= f <= g -> - D <= v <= D -> - (w * (g * D)) <= w * (f * v) <= w * (g * D)).
  { intros w f v W Hf Hv. assert (- (g * D) <= f * v <= g * D) by (split; nra). split; nra. }
  pose proof (prod a (p - 1) (va - m) Ha Fp Na). pose proof (prod b (q - 1) (vb - m) Hb Fq Nb).
  pose proof (prod c (r - 1) (vc - m) Hc Fr Nc). pose proof (prod d (t - 1) (vd - m) Hd Ft Nd).
  assert (Ed : (a * p * va + b * q * vb + c * r * vc + d * t * vd) / (a * p + b * q + c * r + d * t) - m ==
    (a * ((p - 1) * (va - m)) + b * ((q - 1) * (vb - m)) + c * ((r - 1) * (vc - m)) + d * ((t - 1) * (vd - m)))
      / (a * p + b * q + c * r + d * t)).
  { assert (Enum : a * ((p - 1) * (va - m)) + b * ((q - 1) * (vb - m)) + c * ((r - 1) * (vc - m)) + d * ((t - 1) * (vd - m))
      == (a * p * va + b * q * vb + c * r * vc + d * t * vd - m * (a * p + b * q + c * r + d * t)) +
         (m * s - (a * va + b * vb + c * vc + d * vd))) by (unfold s; ring).
    rewrite Enum, Em. field. lra. }
  rewrite Ed.
  set (k := g / low 1). assert (Ek : k * low 1 == g) by (unfold k; field; lra).
  assert (Hk : 0 <= k) by (unfold k; apply Qle_shift_div_l; lra).
  assert (Htot : s * (g * D) <= k * D * (a * p + b * q + c * r + d * t)).
  { assert (0 <= k * D) by nra. assert (k * D * (low 1 * s) <= k * D * (a * p + b * q + c * r + d * t)) by nra.
    assert (Z : k * D * (low 1 * s) == k * low 1 * (s * D)) by ring. rewrite Ek in Z. lra. }
  apply Qabs_Qle_condition. unfold s in Htot. split.
  - apply Qle_shift_div_l; [assumption|]. lra.
  - apply Qle_shift_div_r; [assumption|]. lra.
Qed.
