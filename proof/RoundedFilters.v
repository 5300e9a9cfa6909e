(** The filters for corners that are not snapped (crates/core/src/raster/edge_function_exact.rs and
    crates/core/src/raster/scanline_exact.rs): where the rounded number is farther from zero than the bound, its sign is that
    of the exact one. *)
From Coq Require Import ZArith QArith Qabs Lia Lqa Bool.
From Rasterproof Require Import Rounding RoundedForms.
Open Scope Q_scope.

Lemma approx_sym n x x' : approx n x x' -> approx n x' x.
Proof.
  intros (p & E & L & H). pose proof (low_bounds n). assert (Pp : 0 < p) by lra.
  assert (Hi : 0 < / p) by (apply Qinv_lt_0_compat; assumption).
  assert (I : p * / p == 1) by (apply Qmult_inv_r; lra).
  exists (/ p). repeat split.
  - rewrite E. rewrite <- Qmult_assoc, I. ring.
  - assert (p * low n * / p <= 1 * / p) by (apply Qmult_le_compat_r; lra).
    assert (Z : p * low n * / p == low n * (p * / p)) by ring. rewrite I in Z. lra.
  - assert (low n * / p <= p * / p) by (apply Qmult_le_compat_r; lra). lra.
Qed.

(** How far the exact number is from the rounded one, in terms of the rounded one. *)
Lemma approx_back n x x' : (n <= 20)%nat -> approx n x x' -> Qabs (x' - x) <= drift n * Qabs x'.
Proof.
  intros Hn A. pose proof (approx_error n x' x Hn (approx_sym _ _ _ A)) as H.
  rewrite <- Qabs_opp in H. setoid_replace (- (x - x')) with (x' - x) in H by ring. exact H.
Qed.

Section Filters.
Variable fl : Q -> Q.
Hypothesis R : rounds fl.

Lemma difference_approx x y : is_float x -> is_float y -> approx 1 (x - y) (fl (x - y)).
Proof. intros. eapply approx_round; [apply (fl_difference _ R); assumption | apply approx_refl]. Qed.

(** A product of two rounded differences, which may fall below the normal numbers. *)
Lemma product_back x y x' y' : approx 1 x x' -> approx 1 y y' ->
  Qabs (fl (x' * y') - x * y) <= (drift 2 + u) * Qabs (x' * y') + eta.
Proof.
  intros A B. pose proof (fl_absolute _ R (x' * y')) as F.
  pose proof (approx_back 2 _ _ ltac:(lia) (approx_mul _ _ _ _ _ _ A B)) as P.
  setoid_replace (fl (x' * y') - x * y) with ((fl (x' * y') - x' * y') + (x' * y' - x * y)) by ring.
  eapply Qle_trans; [apply Qabs_triangle|]. lra.
Qed.

(** A rounded product of numbers that are not negative from below. *)
Lemma product_least x y : 0 <= x -> 0 <= y -> (1 - u) * (x * y) - eta <= fl (x * y).
Proof.
  intros. pose proof (fl_absolute _ R (x * y)) as F.
  assert (0 <= x * y) by (apply Qmult_le_0_compat; assumption).
  rewrite (Qabs_pos (x * y)) in F by assumption. apply Qabs_Qle_condition in F. lra.
Qed.

(** ** The edge function: E(p) = dx (py - ay) - dy (px - ax) *)

(** Edge::estimate. *)
Definition estimate (ax ay bx by_ px py : Q) : Q :=
  fl (fl (fl (bx - ax) * fl (py - ay)) - fl (fl (by_ - ay) * fl (px - ax))).

(** Edge::new: reach_x and reach_y are the largest magnitudes of the two rounded differences over a rectangle. *)
Definition edge_bound (ax ay bx by_ reach_x reach_y : Q) : Q :=
  fl (fl (5 * u * fl (fl (Qabs (fl (bx - ax)) * reach_y) + fl (Qabs (fl (by_ - ay)) * reach_x))) + normal).

Theorem edge_filter ax ay bx by_ px py reach_x reach_y :
  is_float ax -> is_float ay -> is_float bx -> is_float by_ -> is_float px -> is_float py -> 
  Qabs (fl (px - ax)) <= reach_x -> Qabs (fl (py - ay)) <= reach_y ->
  Qabs (estimate ax ay bx by_ px py - ((bx - ax) * (py - ay) - (by_ - ay) * (px - ax)))
    <= edge_bound ax ay bx by_ reach_x reach_y.
Proof.
  intros Fax Fay Fbx Fby Fpx Fpy Rx Ry. unfold estimate, edge_bound.
  pose proof (difference_approx bx ax Fbx Fax) as A1. pose proof (difference_approx py ay Fpy Fay) as A2.
  pose proof (difference_approx by_ ay Fby Fay) as A3. pose proof (difference_approx px ax Fpx Fax) as A4.
  set (dx := fl (bx - ax)) in *. set (p := fl (py - ay)) in *.
  set (dy := fl (by_ - ay)) in *. set (q := fl (px - ax)) in *.
  pose proof (product_back _ _ _ _ A1 A2) as P. pose proof (product_back _ _ _ _ A3 A4) as Q.
  assert (G1 : is_float (fl (dx * p))) by apply (fl_float _ R). assert (G2 : is_float (fl (dy * q))) by apply (fl_float _ R).
  pose proof (fl_absolute _ R (dx * p)) as B1. pose proof (fl_absolute _ R (dy * q)) as B2.
  set (f := fl (dx * p)) in *. set (g := fl (dy * q)) in *.
  pose proof (fl_difference _ R f g G1 G2) as D. set (e := fl (f - g)) in *.
  (* The bound from below. *)
  pose proof (product_least (Qabs dx) reach_y (Qabs_nonneg dx) (Qle_trans _ _ _ (Qabs_nonneg p) Ry)) as L1.
  pose proof (product_least (Qabs dy) reach_x (Qabs_nonneg dy) (Qle_trans _ _ _ (Qabs_nonneg q) Rx)) as L2.
  assert (H1 : is_float (fl (Qabs dx * reach_y))) by apply (fl_float _ R).
  assert (H2 : is_float (fl (Qabs dy * reach_x))) by apply (fl_float _ R).
  assert (N1 : 0 <= fl (Qabs dx * reach_y)).
  { apply (fl_sign _ R). apply Qmult_le_0_compat; [apply Qabs_nonneg | exact (Qle_trans _ _ _ (Qabs_nonneg p) Ry)]. }
  assert (N2 : 0 <= fl (Qabs dy * reach_x)).
  { apply (fl_sign _ R). apply Qmult_le_0_compat; [apply Qabs_nonneg | exact (Qle_trans _ _ _ (Qabs_nonneg q) Rx)]. }
  set (m1 := fl (Qabs dx * reach_y)) in *. set (m2 := fl (Qabs dy * reach_x)) in *.
  pose proof (fl_sum _ R m1 m2 H1 H2) as L3. rewrite (Qabs_pos (m1 + m2)) in L3 by lra.
  set (m := fl (m1 + m2)) in *. apply Qabs_Qle_condition in L3.
  assert (N3 : 0 <= m) by (unfold u in *; lra).
  assert (N5 : 0 <= 5 * u) by (unfold u; lra).
  pose proof (product_least (5 * u) m N5 N3) as L4.
  assert (H3 : is_float (fl (5 * u * m))) by apply (fl_float _ R).
  assert (H4 : is_float normal).
  { exists (2 ^ 52)%Z. apply Qeq_bool_iff. vm_compute. reflexivity. }
  assert (N4 : 0 <= fl (5 * u * m)) by (apply (fl_sign _ R); apply Qmult_le_0_compat; assumption).
  set (b := fl (5 * u * m)) in *.
  pose proof (fl_sum _ R b normal H3 H4) as L5.
  assert (Hn : 0 < normal) by reflexivity. rewrite (Qabs_pos (b + normal)) in L5 by lra.
  set (bound := fl (b + normal)) in *. apply Qabs_Qle_condition in L5.
  (* Both sides in terms of s. *)
  assert (Sx : Qabs (dx * p) <= Qabs dx * reach_y).
  { rewrite Qabs_Qmult. pose proof (Qabs_nonneg dx). nra. }
  assert (Sy : Qabs (dy * q) <= Qabs dy * reach_x).
  { rewrite Qabs_Qmult. pose proof (Qabs_nonneg dy). nra. }
  pose proof (Qabs_nonneg (dx * p)). pose proof (Qabs_nonneg (dy * q)).
  set (s1 := Qabs (dx * p)) in *. set (s2 := Qabs (dy * q)) in *.
  set (t1 := Qabs dx * reach_y) in *. set (t2 := Qabs dy * reach_x) in *.
  assert (Fd : Qabs (f - g) <= (1 + u) * (s1 + s2) + 2 * eta).
  { pose proof (Qabs_triangle f (- g)) as T. rewrite Qabs_opp in T.
    pose proof (Qabs_triangle (f - dx * p) (dx * p)) as T1. pose proof (Qabs_triangle (g - dy * q) (dy * q)) as T2.
    setoid_replace (f - dx * p + dx * p) with f in T1 by ring. setoid_replace (g - dy * q + dy * q) with g in T2 by ring.
    fold s1 in T1. fold s2 in T2. setoid_replace (f - g) with (f + - g) by ring. lra. }
  apply Qabs_Qle_condition in D, P, Q, Fd.
  assert (Hu : u * Qabs (f - g) <= u * ((1 + u) * (s1 + s2) + 2 * eta)).
  { assert (Qabs (f - g) <= (1 + u) * (s1 + s2) + 2 * eta) by (apply Qabs_Qle_condition; exact Fd). unfold u in *. lra. }
  assert (He : 0 <= eta) by (apply Qle_bool_iff; vm_compute; reflexivity).
  assert (Hen : 100 * eta <= normal) by (apply Qle_bool_iff; vm_compute; reflexivity).
  assert (Hd : drift 2 <= 2 * u * (1 + (1 # 1048576)) /\ 0 <= drift 2).
  { split; apply Qle_bool_iff; vm_compute; reflexivity. }
  assert (K1 : (drift 2 + u) * s1 <= (3 * u * (1 + (1 # 1048576))) * s1) by (unfold u in *; nra).
  assert (K2 : (drift 2 + u) * s2 <= (3 * u * (1 + (1 # 1048576))) * s2) by (unfold u in *; nra).
  set (k1 := (drift 2 + u) * s1) in *. set (k2 := (drift 2 + u) * s2) in *.
  apply Qabs_Qle_condition.
  set (en := eta) in *. set (nn := normal) in *. clearbody k1 k2 en nn bound b m m1 m2 e f g s1 s2 t1 t2.
  set (x := (bx - ax) * (py - ay)) in *. set (y := (by_ - ay) * (px - ax)) in *. clearbody x y.
  unfold u in *. split; lra.
Qed.

(** ** The scanline: x = ax + (yc - ay) dx / dy, less half a pixel *)

(** Edge::crossing and Edge::column. *)
Definition quotient (ax ay bx by_ yc : Q) : Q := fl (fl (fl (yc - ay) * fl (bx - ax)) / fl (by_ - ay)).

Definition crossing (ax ay bx by_ yc : Q) : Q := fl (ax + quotient ax ay bx by_ yc).

Definition crossing_bound (x t : Q) : Q := fl (6 * u * fl (fl (Qabs x + Qabs t) + 1)).

Definition lowest (x error : Q) : Q := fl (fl (x - (1 # 2)) - error).

Definition highest (x error : Q) : Q := fl (fl (x - (1 # 2)) + error).

(** 2^-54: a corner differs from a half-integer by no less. *)
Definition least_height : Q := Eval compute in 1 # (2 ^ 54).

Lemma is_float_abs x : is_float x -> is_float (Qabs x).
Proof.
  intros [k E]. exists (Z.abs k). rewrite E, Qabs_Qmult. change (Qabs (1 # 2 ^ 1074)) with (1 # 2 ^ 1074). reflexivity.
Qed.

Theorem scanline_filter ax ay bx by_ yc : is_float ax -> is_float ay -> is_float bx -> is_float by_ -> is_float yc ->
  least_height <= by_ - ay ->
  let t := quotient ax ay bx by_ yc in
  let x := crossing ax ay bx by_ yc in
  let exact := ax + (yc - ay) * (bx - ax) / (by_ - ay) in
  lowest x (crossing_bound x t) <= exact - (1 # 2) <= highest x (crossing_bound x t).
Proof.
  intros Fax Fay Fbx Fby Fyc Hh. cbv zeta. unfold lowest, highest, crossing_bound, crossing, quotient.
  assert (Hl : 0 < least_height) by reflexivity.
  pose proof (difference_approx yc ay Fyc Fay) as A1. pose proof (difference_approx bx ax Fbx Fax) as A2.
  pose proof (difference_approx by_ ay Fby Fay) as A3.
  set (down := fl (yc - ay)) in *. set (dx := fl (bx - ax)) in *. set (dy := fl (by_ - ay)) in *.
  destruct (split_error _ _ (fl_absolute _ R (down * dx))) as (z & e & Ez & Hz & He).
  set (prod := fl (down * dx)) in *.
  pose proof (approx_round _ _ _ _ Hz (approx_mul _ _ _ _ _ _ A1 A2)) as Az. cbn [Nat.add] in Az.
  assert (Ny : ~ by_ - ay == 0) by lra.
  destruct (approx_at _ _ _ A3) as (P3 & L3 & _); [lra|].
  assert (Hdy : (1 # 2) * least_height <= dy) by (cbn [low] in L3; unfold u in *; lra).
  pose proof (approx_div _ _ _ _ _ _ Ny Az A3) as Aq. cbn [Nat.add] in Aq.
  destruct (split_error _ _ (fl_absolute _ R (prod / dy))) as (q & e' & Eq & Hq & He').
  destruct (rounding_factor _ _ Hq) as (d & Zd & Hd).
  assert (Ft : is_float (fl (prod / dy))) by apply (fl_float _ R).
  set (t := fl (prod / dy)) in *.
  pose proof (approx_factor _ _ _ _ Hd Aq) as At.
  set (exact := (yc - ay) * (bx - ax) / (by_ - ay)) in *. set (t0 := z / dy * (1 + d)) in *.
  assert (Et : t == t0 + (e * / dy * (1 + d) + e')).
  { rewrite Eq, Zd, Ez. unfold t0. field. lra. }
  pose proof (approx_back 5 _ _ ltac:(lia) At) as Bt.
  set (tiny := 1 # 2 ^ 1015).
  assert (Hsmall : Qabs (e * / dy * (1 + d) + e') <= tiny).
  { assert (Hi : / dy <= inject_Z (2 ^ 55)).
    { assert (Pd : 0 < dy) by lra. assert (I : dy * / dy == 1) by (apply Qmult_inv_r; lra).
      assert (0 < / dy) by (apply Qinv_lt_0_compat; assumption).
      assert (E55 : (1 # 2) * least_height * inject_Z (2 ^ 55) == 1) by (apply Qeq_bool_iff; vm_compute; reflexivity).
      destruct (Qlt_le_dec (inject_Z (2 ^ 55)) (/ dy)) as [C|C]; [|assumption]. exfalso.
      assert (0 < inject_Z (2 ^ 55)) by reflexivity. set (k := inject_Z (2 ^ 55)) in *. clearbody k.
      assert ((1 # 2) * least_height * k <= dy * k) by nra. assert (dy * k < dy * / dy) by nra. lra. }
    assert (Pi : 0 < / dy) by (apply Qinv_lt_0_compat; lra).
    assert (P1 : Qabs (/ dy) <= inject_Z (2 ^ 55)) by (rewrite Qabs_pos; lra).
    assert (P2 : Qabs (1 + d) <= 2) by (apply Qabs_Qle_condition; unfold u in *; lra).
    pose proof (abs_mul_le _ _ _ _ (abs_mul_le _ _ _ _ He P1) P2) as P.
    assert (S : eta * inject_Z (2 ^ 55) * 2 + eta <= tiny) by (apply Qle_bool_iff; vm_compute; reflexivity).
    eapply Qle_trans; [apply Qabs_triangle|]. lra. }
  set (rest := e * / dy * (1 + d) + e') in *. clearbody rest t0.
  assert (Htiny : 0 <= tiny) by (apply Qle_bool_iff; vm_compute; reflexivity).
  assert (Hd5 : 0 <= drift 5 <= 5 * u * (1 + (1 # 1048576))) by (split; apply Qle_bool_iff; vm_compute; reflexivity).
  assert (Tt : Qabs t0 <= Qabs t + tiny).
  { setoid_replace t0 with (t - rest) by (rewrite Et; ring). pose proof (Qabs_triangle t (- rest)) as T.
    rewrite Qabs_opp in T. setoid_replace (t - rest) with (t + - rest) by ring. lra. }
  pose proof (Qabs_nonneg t) as Nt. pose proof (Qabs_nonneg t0) as Nt0.
  assert (Bt' : Qabs (t0 - exact) <= 5 * u * (1 + (1 # 1048576)) * (Qabs t + tiny)).
  { eapply Qle_trans; [exact Bt|]. assert (drift 5 * Qabs t0 <= (5 * u * (1 + (1 # 1048576))) * Qabs t0) by nra.
    unfold u in *. lra. }
  (* The sum, half a pixel, and the bound. *)
  pose proof (fl_sum _ R ax t Fax Ft) as Sx. assert (Fx : is_float (fl (ax + t))) by apply (fl_float _ R).
  set (x := fl (ax + t)) in *.
  assert (Fh : is_float (1 # 2)) by (exists (2 ^ 1073)%Z; apply Qeq_bool_iff; vm_compute; reflexivity).
  pose proof (fl_difference _ R x (1 # 2) Fx Fh) as Sc. assert (Fc : is_float (fl (x - (1 # 2)))) by apply (fl_float _ R).
  set (c := fl (x - (1 # 2))) in *.
  pose proof (fl_sum _ R _ _ (is_float_abs _ Fx) (is_float_abs _ Ft)) as S1.
  pose proof (Qabs_nonneg x) as Nx. rewrite (Qabs_pos (Qabs x + Qabs t)) in S1 by lra.
  assert (F1 : is_float (fl (Qabs x + Qabs t))) by apply (fl_float _ R).
  set (m := fl (Qabs x + Qabs t)) in *. apply Qabs_Qle_condition in S1.
  assert (Fo : is_float 1) by (exists (2 ^ 1074)%Z; apply Qeq_bool_iff; vm_compute; reflexivity).
  pose proof (fl_sum _ R m 1 F1 Fo) as S2.
  assert (Nm : 0 <= m) by (unfold u in *; lra). rewrite (Qabs_pos (m + 1)) in S2 by lra.
  set (n := fl (m + 1)) in *. apply Qabs_Qle_condition in S2.
  assert (Nn : 1 # 2 <= n) by (unfold u in *; lra).
  pose proof (fl_absolute _ R (6 * u * n)) as S3.
  assert (N8 : 0 <= 6 * u * n) by (unfold u; lra). rewrite (Qabs_pos (6 * u * n)) in S3 by assumption.
  assert (Fe : is_float (fl (6 * u * n))) by apply (fl_float _ R).
  set (err := fl (6 * u * n)) in *. apply Qabs_Qle_condition in S3.
  pose proof (fl_difference _ R c err Fc Fe) as Slow. pose proof (fl_sum _ R c err Fc Fe) as Shigh.
  set (lo := fl (c - err)) in *. set (hi := fl (c + err)) in *. clearbody lo hi err n m c x.
  assert (Heta : 0 <= eta <= tiny) by (split; apply Qle_bool_iff; vm_compute; reflexivity).
  assert (Ht8 : 1000000 * tiny <= u) by (apply Qle_bool_iff; vm_compute; reflexivity).
  set (h := eta) in *. set (ti := tiny) in *. clearbody h ti.
  (* Magnitudes. *)
  assert (Mx : Qabs (ax + t) <= (1 + 2 * u) * Qabs x).
  { pose proof (Qabs_triangle (ax + t - x) x) as T. setoid_replace (ax + t - x + x) with (ax + t) in T by ring.
    pose proof (Qabs_nonneg (ax + t)).
    assert (E : Qabs (ax + t - x) == Qabs (x - (ax + t))) by (rewrite <- Qabs_opp; setoid_replace (- (ax + t - x)) with (x - (ax + t)) by ring; reflexivity).
    unfold u in *. lra. }
  assert (Mc : Qabs (x - (1 # 2)) <= Qabs x + (1 # 2)).
  { pose proof (Qabs_triangle x (- (1 # 2))) as T. exact T. }
  assert (Mc2 : Qabs c <= (1 + u) * (Qabs x + (1 # 2))).
  { pose proof (Qabs_triangle (c - (x - (1 # 2))) (x - (1 # 2))) as T.
    setoid_replace (c - (x - (1 # 2)) + (x - (1 # 2))) with c in T by ring. unfold u in *. lra. }
  assert (Pe : 0 <= err) by (unfold u in *; lra).
  assert (Ml : Qabs (c - err) <= Qabs c + err).
  { pose proof (Qabs_triangle c (- err)) as T. rewrite Qabs_opp, (Qabs_pos err) in T by assumption. exact T. }
  assert (Mh : Qabs (c + err) <= Qabs c + err).
  { pose proof (Qabs_triangle c err) as T. rewrite (Qabs_pos err) in T by assumption. exact T. }
  set (xx := Qabs x) in *. set (tt := Qabs t) in *.
  assert (Ux : u * Qabs (ax + t) <= u * ((1 + 2 * u) * xx)) by (unfold u in *; lra).
  assert (Uc : u * Qabs (x - (1 # 2)) <= u * (xx + (1 # 2))) by (unfold u in *; lra).
  assert (Ul : u * Qabs (c - err) <= u * ((1 + u) * (xx + (1 # 2)) + err)) by (unfold u in *; lra).
  assert (Uh : u * Qabs (c + err) <= u * ((1 + u) * (xx + (1 # 2)) + err)) by (unfold u in *; lra).
  apply Qabs_Qle_condition in Hsmall, Bt', Sx, Sc, Slow, Shigh.
  clearbody xx tt. clear - Et Hsmall Bt' Sx Sc Slow Shigh Ux Uc Ul Uh S1 S2 S3 Heta Ht8 Nx Nt.
  unfold u in *. split; lra.
Qed.
End Filters.
