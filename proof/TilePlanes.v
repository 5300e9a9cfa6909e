(** The planes of the tiles (crates/tiles/src/frames/planes.rs) with corners on the lattice and edges shorter than 2^18 px: the
    area is computed exactly, T is off by a few roundings, and so the bounds that the code computes hold for its values. *)
From Coq Require Import ZArith QArith Qabs Lia Lqa.
From Rasterproof Require Import Coverage Rounding Nearest Parameters RoundedValues RoundedFilters EngineValues PlaneModel Planes.
Open Scope Q_scope.

(** ** Numbers that f64 holds *)

Lemma nearest_exact v z k : v == inject_Z z * pow2 k -> (Z.abs z < 2 ^ 53)%Z -> (-1074 <= k)%Z -> nearest v == v.
Proof.
  intros E B K. destruct (Z.lt_trichotomy z 0) as [N | [O | P]].
  - assert (D : double (- v)).
    { exists (- z)%Z, k. split; [rewrite E, inject_Z_opp; ring | lia]. }
    pose proof (nearest_of_double _ D) as R. pose proof (pow2_positive k) as P.
    assert (Z1 : inject_Z z <= -1) by (change (-1) with (inject_Z (-1)); rewrite <- Zle_Qle; lia).
    assert (V : v < 0) by (rewrite E; nra). unfold nearest.
    destruct (Qeq_bool v 0) eqn:E0; [apply Qeq_bool_iff in E0; lra|].
    destruct (Qle_bool 0 v) eqn:E1; [apply Qle_bool_iff in E1; lra|].
    rewrite nearest_of_positive in R by lra. rewrite R. ring.
  - assert (V : v == 0) by (rewrite E, O; change (inject_Z 0) with 0; ring). rewrite (nearest_of_zero v V), V. reflexivity.
  - apply nearest_of_double. exists z, k. split; [assumption | lia].
Qed.

Lemma pixels_exact z : (Z.abs z < 2 ^ 53)%Z -> pixels z == inject_Z z * pow2 (-8).
Proof.
  intros B. unfold pixels. assert (I : nearest (inject_Z z) == inject_Z z).
  { apply (nearest_exact _ z 0); [change (pow2 0) with 1; ring | assumption | lia]. }
  assert (E : nearest (inject_Z z) / inject_Z 256 == inject_Z z * pow2 (-8)).
  { rewrite I. assert (P : pow2 (-8) == 1 # 256) by (apply Qeq_bool_iff; vm_compute; reflexivity). rewrite P.
    change (inject_Z 256) with (256 # 1). field. }
  rewrite (nearest_exact _ z (-8) E B ltac:(lia)). exact E.
Qed.

Lemma relative_rounding x : normal <= Qabs x -> Qabs (nearest x - x) <= u * Qabs x.
Proof.
  intros H. apply (fl_relative _ nearest_rounds). destruct (Qlt_le_dec x 0) as [N | P].
  - right. left. rewrite Qabs_neg in H by lra. lra.
  - left. rewrite Qabs_pos in H; assumption.
Qed.

Lemma rounding_of_abs p q : Qabs (p - q) <= u * Qabs q -> Qabs (Qabs p - Qabs q) <= u * Qabs (Qabs q).
Proof.
  intros R. rewrite (Qabs_pos (Qabs q)) by apply Qabs_nonneg. apply Qle_trans with (Qabs (p - q)); [|assumption].
  pose proof (Qabs_triangle_reverse p q) as S. pose proof (Qabs_triangle_reverse q p) as T. rewrite <- (Qabs_opp (q - p)) in T.
  setoid_replace (- (q - p)) with (p - q) in T by ring. apply Qabs_Qle_condition. split; lra.
Qed.

Lemma lower x : 0 <= x -> (1 - u) * x - eta <= nearest x.
Proof.
  intros H. pose proof (fl_absolute _ nearest_rounds x) as A. rewrite (Qabs_pos x H) in A.
  apply Qabs_Qle_condition in A. set (e := eta) in *. unfold u in *. lra.
Qed.

Lemma larger_spec p q : p <= larger p q /\ q <= larger p q /\ (larger p q = p \/ larger p q = q).
Proof.
  unfold larger. destruct (Qle_bool p q) eqn:E.
  - apply Qle_bool_iff in E. split; [assumption | split; [lra | right; reflexivity]].
  - assert (q <= p). { destruct (Qlt_le_dec q p); [lra|]. apply Qle_bool_iff in q0. congruence. }
    split; [lra | split; [assumption | left; reflexivity]].
Qed.

Lemma larger_not_negative p q : 0 <= q -> 0 <= larger p q.
Proof. intros H. destruct (larger_spec p q) as (_ & L & _). lra. Qed.

Lemma growth_at_most x1 y1 x2 y2 area X0 Y0 M x y W H : 0 <= M -> Qabs x <= W -> Qabs y <= H ->
  growth x1 y1 x2 y2 area X0 Y0 M x y <=
    M * (1 + 2 * ((Qabs y1 + Qabs y2) * (Qabs X0 + W) + (Qabs x1 + Qabs x2) * (Qabs Y0 + H)) * Qabs (1 / area)).
Proof.
  intros M0 Wx Hy. unfold growth, steepest. pose proof (Qabs_nonneg x1). pose proof (Qabs_nonneg y1). pose proof (Qabs_nonneg x2).
  pose proof (Qabs_nonneg y2). pose proof (Qabs_nonneg (1 / area)).
  set (p := Qabs (1 / area)) in *. set (a1 := Qabs x1) in *. set (b1 := Qabs y1) in *. set (a2 := Qabs x2) in *. set (b2 := Qabs y2) in *.
  set (X := Qabs X0) in *. set (Y := Qabs Y0) in *. set (i := Qabs x) in *. set (j := Qabs y) in *. clearbody p a1 b1 a2 b2 X Y i j.
  setoid_replace (M + ((2 * M * b2 + 2 * M * b1) * p * (X + i) + (2 * M * a1 + 2 * M * a2) * p * (Y + j))) with
    (M * (1 + 2 * ((b1 + b2) * (X + i) + (a1 + a2) * (Y + j)) * p)) by ring.
  rewrite !(Qmult_comm M). apply Qmult_le_compat_r; [|assumption]. apply Qplus_le_compat; [lra|].
  apply Qmult_le_compat_r; [|assumption].
  assert (I : (b1 + b2) * (X + i) <= (b1 + b2) * (X + W)) by (rewrite !(Qmult_comm (b1 + b2)); apply Qmult_le_compat_r; lra).
  assert (J : (a1 + a2) * (Y + j) <= (a1 + a2) * (Y + H)) by (rewrite !(Qmult_comm (a1 + a2)); apply Qmult_le_compat_r; lra).
  lra.
Qed.

Lemma size_arithmetic M m t g e k : 0 <= M -> 0 <= m -> 0 <= t -> t <= 1 # 2 ^ 1000 -> 0 <= g <= inject_Z (2 ^ 119) -> 0 <= e ->
  e <= g * (1 + drift 8) -> M <= (m + t) * (1 + (1 # 2 ^ 50)) -> k <= M * e ->
  0 <= nearest (m * g) /\ k <= nearest (m * g) * (1 + (1 # 2 ^ 30)) + (1 # 2 ^ 800).
Proof.
  intros M0 Mp T0 BT [G0 G1] E0 G K Hk. assert (MG : 0 <= m * g) by (apply Qmult_le_0_compat; assumption).
  pose proof (lower _ MG) as L. split; [exact (fl_sign _ nearest_rounds _ MG)|]. set (r := nearest (m * g)) in *. clearbody r.
  assert (D : drift 8 <= 1 # 2 ^ 49) by (apply Qle_bool_iff; vm_compute; reflexivity).
  assert (H1 : M * e <= (m + t) * (1 + (1 # 2 ^ 50)) * e) by (apply Qmult_le_compat_r; assumption).
  assert (H2 : e <= g * (1 + (1 # 2 ^ 49))).
  { apply (Qle_trans _ _ _ G). rewrite !(Qmult_comm g). apply Qmult_le_compat_r; lra. }
  assert (H3 : (m + t) * (1 + (1 # 2 ^ 50)) * e <= (m + t) * (1 + (1 # 2 ^ 50)) * (g * (1 + (1 # 2 ^ 49)))).
  { rewrite !(Qmult_comm ((m + t) * (1 + (1 # 2 ^ 50)))). apply Qmult_le_compat_r; [assumption|].
    apply Qmult_le_0_compat; [lra | discriminate]. }
  assert (H4 : t * g <= (1 # 2 ^ 1000) * inject_Z (2 ^ 119)).
  { apply Qle_trans with ((1 # 2 ^ 1000) * g); [apply Qmult_le_compat_r; assumption|].
    rewrite !(Qmult_comm (1 # 2 ^ 1000)). apply Qmult_le_compat_r; [assumption | discriminate]. }
  assert (H5 : 4 * ((1 # 2 ^ 1000) * inject_Z (2 ^ 119)) + 4 * eta <= 1 # 2 ^ 800) by (apply Qle_bool_iff; vm_compute; reflexivity).
  assert (T1 : 0 <= t * g) by (apply Qmult_le_0_compat; assumption). assert (Ep : 0 <= eta) by discriminate.
  set (o := 1 # 2 ^ 800) in *. set (z := (1 # 2 ^ 1000) * inject_Z (2 ^ 119)) in *. set (h := eta) in *. clearbody o z h.
  assert (P : (1 + (1 # 2 ^ 50)) * (1 + (1 # 2 ^ 49)) <= 1 + (1 # 281474976710656)) by (apply Qle_bool_iff; vm_compute; reflexivity).
  set (p := 1 + (1 # 2 ^ 50)) in *. set (q := 1 + (1 # 2 ^ 49)) in *. clearbody p q.
  setoid_replace ((m + t) * p * (g * q)) with (p * q * (m * g + t * g)) in H3 by ring.
  assert (H6 : p * q * (m * g + t * g) <= (1 + (1 # 281474976710656)) * (m * g + t * g)) by (apply Qmult_le_compat_r; lra).
  change (1 # 2 ^ 30) with (1 # 1073741824).
  set (mg := m * g) in *. set (tg := t * g) in *. set (pq := p * q * (mg + tg)) in *. set (me := M * e) in *. set (mte := (m + t) * p * e) in *.
  clearbody mg tg pq me mte. clear P K G H2 D. unfold u in L. lra.
Qed.

Lemma lower_abs x : (1 - u) * Qabs x - eta <= Qabs (nearest x).
Proof.
  pose proof (fl_absolute _ nearest_rounds x) as A. pose proof (Qabs_triangle (nearest x) (x - nearest x)) as T.
  setoid_replace (nearest x + (x - nearest x)) with x in T by ring. rewrite <- (Qabs_opp (x - nearest x)) in T.
  setoid_replace (- (x - nearest x)) with (nearest x - x) in T by ring. set (e := eta) in *. unfold u in *. lra.
Qed.

Lemma eta_small : 0 <= eta /\ eta <= 1 # 2 ^ 200.
Proof. split; [discriminate | apply Qle_bool_iff; vm_compute; reflexivity]. Qed.

(** ** The bounds that the code computes are not smaller than what is proved *)

Lemma computed_error_holds s r d x y T e : 0 <= T -> e <= plane_bound 4 11 20 127 (size s r d x y) T ->
  e <= computed_error 4 11 18 126 (computed_size s r d x y) T.
Proof.
  unfold plane_bound, size, computed_error, computed_size. intros Tp He. destruct eta_small as [E0 E1].
  pose proof (Qabs_nonneg s) as I. pose proof (Qabs_nonneg (nearest32 (r * x))) as J. pose proof (Qabs_nonneg (nearest32 (d * y))) as K.
  set (i := Qabs s) in *. set (j := Qabs (nearest32 (r * x))) in *. set (k := Qabs (nearest32 (d * y))) in *. clearbody i j k.
  change (inject_Z (Z.pos 4)) with 4 in *. change (inject_Z (Z.pos 11)) with 11 in *.
  pose proof (lower (i + j) ltac:(lra)) as L1. pose proof (fl_sign _ nearest_rounds (i + j) ltac:(lra)) as P1.
  set (s1 := nearest (i + j)) in *. clearbody s1.
  pose proof (lower (s1 + k) ltac:(lra)) as L2. pose proof (fl_sign _ nearest_rounds (s1 + k) ltac:(lra)) as P2.
  set (s2 := nearest (s1 + k)) in *. clearbody s2.
  assert (Q3 : 0 <= 4 * w * s2) by (unfold w; lra). assert (Q4 : 0 <= 11 * u * T) by (unfold u; lra).
  pose proof (lower _ Q3) as L3. pose proof (fl_sign _ nearest_rounds _ Q3) as P3. set (p := nearest (4 * w * s2)) in *. clearbody p.
  pose proof (lower _ Q4) as L4. pose proof (fl_sign _ nearest_rounds _ Q4) as P4. set (q := nearest (11 * u * T)) in *. clearbody q.
  pose proof (lower (p + q) ltac:(lra)) as L5. pose proof (fl_sign _ nearest_rounds (p + q) ltac:(lra)) as P5.
  set (f := nearest (p + q)) in *. clearbody f. change (1 # 2 ^ 18) with (1 # 262144). change (1 # 2 ^ 20) with (1 # 1048576) in He.
  assert (Q6 : 0 <= f * (1 + (1 # 262144))) by lra.
  pose proof (lower _ Q6) as L6. pose proof (fl_sign _ nearest_rounds _ Q6) as P6. set (g := nearest (f * (1 + (1 # 262144)))) in *. clearbody g.
  assert (Q7 : 0 <= g + (1 # 2 ^ 126)) by (assert (0 <= 1 # 2 ^ 126) by discriminate; lra). pose proof (lower _ Q7) as L7.
  set (o := nearest (g + (1 # 2 ^ 126))) in *. clearbody o. set (h := eta) in *. clearbody h.
  assert (F : 16 * (1 # 2 ^ 200) + (1 # 2 ^ 127) <= (1 - u) * (1 # 2 ^ 126)) by (apply Qle_bool_iff; vm_compute; reflexivity).
  set (c126 := 1 # 2 ^ 126) in *. set (c127 := 1 # 2 ^ 127) in *. set (z := 1 # 2 ^ 200) in *. clearbody c126 c127 z.
  unfold w, u in *. lra.
Qed.

Lemma computed_quotient_holds en eq n q e : is_float eq -> is_float q -> 0 <= eq -> eq < q -> q <= inject_Z (2 ^ 80) ->
  1 # 2 ^ 127 <= en -> e <= quotient_bound 2 20 130 en eq n q -> e <= computed_quotient_error 2 18 126 en eq n q.
Proof.
  unfold quotient_bound, computed_quotient_error. cbv zeta. intros Feq Fq Eq0 Lt Most En He. destruct eta_small as [E0 E1].
  pose proof (lower_abs (n / q)) as A. pose proof (Qabs_nonneg (nearest (n / q))) as A0. pose proof (Qabs_nonneg (n / q)) as B0.
  set (a := Qabs (nearest (n / q))) in *. set (b := Qabs (n / q)) in *. clearbody a b.
  pose proof (fl_difference _ nearest_rounds q eq Fq Feq) as D. rewrite (Qabs_pos (q - eq)) in D by lra.
  apply Qabs_Qle_condition in D. set (d := nearest (q - eq)) in *. clearbody d.
  assert (D1 : 0 < d) by (unfold u in D; lra). assert (D2 : d <= (1 + u) * (q - eq)) by (unfold u in *; lra). clear D.
  assert (P0 : 0 <= a * eq) by (apply Qmult_le_0_compat; assumption). pose proof (lower _ P0) as P1.
  pose proof (fl_sign _ nearest_rounds _ P0) as P2. set (p := nearest (a * eq)) in *. clearbody p.
  assert (P3 : ((1 - u) * b - eta) * eq <= a * eq) by (apply Qmult_le_compat_r; assumption).
  assert (P4 : eta * eq <= 1 # 2 ^ 200).
  { apply Qle_trans with (eta * inject_Z (2 ^ 80)); [|apply Qle_bool_iff; vm_compute; reflexivity].
    rewrite !(Qmult_comm eta). apply Qmult_le_compat_r; [lra | discriminate]. }
  assert (Z : 16 * (1 # 2 ^ 200) <= u * (1 # 2 ^ 127)) by (apply Qle_bool_iff; vm_compute; reflexivity).
  assert (En0 : 0 <= en) by (apply (Qle_trans _ (1 # 2 ^ 127)); [discriminate | assumption]).
  assert (Z1 : 16 * (1 # 2 ^ 200) <= u * en).
  { apply (Qle_trans _ _ _ Z). rewrite !(Qmult_comm u). apply Qmult_le_compat_r; [assumption | discriminate]. }
  pose proof (lower (en + p) ltac:(lra)) as S1. pose proof (fl_sign _ nearest_rounds (en + p) ltac:(lra)) as S2.
  set (s := nearest (en + p)) in *. clearbody s.
  assert (BE : 0 <= b * eq) by (apply Qmult_le_0_compat; assumption).
  setoid_replace (((1 - u) * b - eta) * eq) with ((1 - u) * (b * eq) - eta * eq) in P3 by ring.
  assert (S3 : (1 - 4 * u) * (en + b * eq) <= s).
  { set (be := b * eq) in *. set (ae := a * eq) in *. set (he := eta * eq) in *. set (h := eta) in *. set (z := 1 # 2 ^ 200) in *.
    clearbody be ae he h z. unfold u in *. lra. }
  set (m := en + b * eq) in *. assert (M0 : 0 <= m) by (unfold m; lra).
  assert (Q0 : 0 < q - eq) by lra. set (off := m / (q - eq)) in *.
  assert (O0 : 0 <= off) by (apply Qle_shift_div_l; lra).
  assert (O1 : off * (q - eq) == m) by (unfold off; field; lra).
  assert (O2 : (1 - 6 * u) * off <= s / d).
  { apply Qle_shift_div_l; [assumption|]. assert (O3 : off * d <= off * ((1 + u) * (q - eq))).
    { rewrite !(Qmult_comm off). apply Qmult_le_compat_r; assumption. }
    setoid_replace (off * ((1 + u) * (q - eq))) with ((1 + u) * (off * (q - eq))) in O3 by ring. rewrite O1 in O3.
    setoid_replace ((1 - 6 * u) * off * d) with ((1 - 6 * u) * (off * d)) by ring. set (od := off * d) in *. clearbody od m.
    unfold u in *. lra. }
  clearbody off. assert (R0 : 0 <= s / d) by (unfold u in O2; lra). pose proof (lower _ R0) as R1.
  set (sd := s / d) in *. clearbody sd. pose proof (fl_sign _ nearest_rounds _ R0) as R2. set (f := nearest sd) in *. clearbody f.
  change (inject_Z (Z.pos 2)) with 2 in *. assert (T0 : 0 <= 2 * w * a) by (unfold w; lra). pose proof (lower _ T0) as T1.
  pose proof (fl_sign _ nearest_rounds _ T0) as T2. set (t := nearest (2 * w * a)) in *. clearbody t.
  pose proof (lower (f + t) ltac:(lra)) as U1. pose proof (fl_sign _ nearest_rounds (f + t) ltac:(lra)) as U2.
  set (g := nearest (f + t)) in *. clearbody g. change (1 # 2 ^ 18) with (1 # 262144). change (1 # 2 ^ 20) with (1 # 1048576) in He.
  assert (V0 : 0 <= g * (1 + (1 # 262144))) by lra. pose proof (lower _ V0) as V1. pose proof (fl_sign _ nearest_rounds _ V0) as V2.
  set (v := nearest (g * (1 + (1 # 262144)))) in *. clearbody v.
  assert (W0 : 0 <= v + (1 # 2 ^ 126)) by (assert (0 <= 1 # 2 ^ 126) by discriminate; lra). pose proof (lower _ W0) as W1.
  set (o := nearest (v + (1 # 2 ^ 126))) in *. clearbody o. set (h := eta) in *. clearbody h.
  assert (F : 16 * (1 # 2 ^ 200) + (1 # 2 ^ 130) <= (1 - u) * (1 # 2 ^ 126)) by (apply Qle_bool_iff; vm_compute; reflexivity).
  set (c126 := 1 # 2 ^ 126) in *. set (c130 := 1 # 2 ^ 130) in *. set (z := 1 # 2 ^ 200) in *. clearbody c126 c130 z.
  clear - He W1 V1 U1 T1 R1 O2 A E0 E1 F O0 B0 A0. unfold w, u in *. lra.
Qed.

(** ** The area *)

Section Corners.
Variables (a b c : point) (x0 y0 : Z).
Notation dx1 := (X b - X a)%Z. Notation dy1 := (Y b - Y a)%Z. Notation dx2 := (X c - X a)%Z. Notation dy2 := (Y c - Y a)%Z.
(** Edges below 2^18 px, in subpixels. *)
Hypothesis (D1 : (Z.abs dx1 < 2 ^ 26)%Z) (D2 : (Z.abs dy1 < 2 ^ 26)%Z).
Hypothesis (D3 : (Z.abs dx2 < 2 ^ 26)%Z) (D4 : (Z.abs dy2 < 2 ^ 26)%Z).
Hypothesis Area : (dx1 * dy2 - dx2 * dy1 <> 0)%Z.
(** The first corner, and the centre of the first pixel. *)
Hypothesis (DX : (Z.abs (x0 * 256 + 128 - X a) < 2 ^ 32)%Z) (DY : (Z.abs (y0 * 256 + 128 - Y a) < 2 ^ 32)%Z).

Notation x1 := (pixels dx1). Notation y1 := (pixels dy1). Notation x2 := (pixels dx2). Notation y2 := (pixels dy2).
Notation X0 := (pixels (x0 * 256 + 128 - X a)). Notation Y0 := (pixels (y0 * 256 + 128 - Y a)).
Definition area : Q := x1 * y2 - x2 * y1.
Notation computed_area := (nearest (nearest (x1 * y2) - nearest (x2 * y1))).
Notation pa := (nearest (1 / computed_area)).

Lemma product_small z z' : (Z.abs z < 2 ^ 26)%Z -> (Z.abs z' < 2 ^ 26)%Z -> (Z.abs (z * z') < 2 ^ 52)%Z.
Proof.
  intros A B. rewrite Z.abs_mul. change (2 ^ 52)%Z with (2 ^ 26 * 2 ^ 26)%Z.
  apply Z.mul_lt_mono_nonneg; [apply Z.abs_nonneg | assumption | apply Z.abs_nonneg | assumption].
Qed.

Lemma area_small : (Z.abs (dx1 * dy2 - dx2 * dy1) < 2 ^ 53)%Z.
Proof. pose proof (product_small _ _ D1 D4). pose proof (product_small _ _ D3 D2). lia. Qed.

Lemma product_exact z z' : (Z.abs z < 2 ^ 26)%Z -> (Z.abs z' < 2 ^ 26)%Z ->
  nearest (pixels z * pixels z') == inject_Z (z * z') * pow2 (-16) /\ pixels z * pixels z' == inject_Z (z * z') * pow2 (-16).
Proof.
  intros A B. assert (E : pixels z * pixels z' == inject_Z (z * z') * pow2 (-16)).
  { rewrite !pixels_exact, inject_Z_mult by lia. assert (P : pow2 (-16) == pow2 (-8) * pow2 (-8)) by (rewrite <- pow2_add; reflexivity).
    rewrite P. ring. }
  split; [|exact E]. rewrite (nearest_exact _ (z * z') (-16) E); [exact E | pose proof (product_small _ _ A B); lia | lia].
Qed.

Lemma area_whole : area == inject_Z (dx1 * dy2 - dx2 * dy1) * pow2 (-16).
Proof.
  unfold area. destruct (product_exact dx1 dy2 D1 D4) as [_ P]. destruct (product_exact dx2 dy1 D3 D2) as [_ R].
  rewrite P, R. unfold Z.sub at 5. rewrite inject_Z_plus, inject_Z_opp. ring.
Qed.

Theorem area_is_exact : computed_area == area.
Proof.
  destruct (product_exact dx1 dy2 D1 D4) as [P _]. destruct (product_exact dx2 dy1 D3 D2) as [R _].
  assert (E : nearest (x1 * y2) - nearest (x2 * y1) == inject_Z (dx1 * dy2 - dx2 * dy1) * pow2 (-16)).
  { rewrite P, R. unfold Z.sub at 5. rewrite inject_Z_plus, inject_Z_opp. ring. }
  rewrite (nearest_exact _ _ _ E); [|exact area_small | lia]. rewrite E. symmetry. exact area_whole.
Qed.

Lemma area_size : 1 <= Qabs area * inject_Z (2 ^ 16) /\ Qabs area <= inject_Z (2 ^ 37).
Proof.
  pose proof area_whole as W. set (z := (dx1 * dy2 - dx2 * dy1)%Z) in *.
  assert (B : (1 <= Z.abs z < 2 ^ 53)%Z) by (pose proof area_small; unfold z in *; lia).
  assert (P : pow2 (-16) == 1 # 65536) by (apply Qeq_bool_iff; vm_compute; reflexivity).
  assert (S : Qabs area == inject_Z (Z.abs z) * (1 # 65536)).
  { rewrite (Qabs_wd _ _ W), P, Qabs_Qmult. reflexivity. }
  rewrite S. clearbody z. clear W S.
  assert (B1 : 1 <= inject_Z (Z.abs z)) by (change 1 with (inject_Z 1); rewrite <- Zle_Qle; lia).
  assert (B2 : inject_Z (Z.abs z) <= inject_Z (2 ^ 53)) by (rewrite <- Zle_Qle; lia).
  change (inject_Z (2 ^ 16)) with (65536 # 1). change (inject_Z (2 ^ 37)) with (137438953472 # 1).
  change (inject_Z (2 ^ 53)) with (9007199254740992 # 1) in B2. split; lra.
Qed.

Lemma area_sized : sized 37 (Qabs area).
Proof.
  destruct area_size as [L U]. split; [|exact U]. unfold two. change (inject_Z (2 ^ Z.of_nat 37)) with (137438953472 # 1).
  change (inject_Z (2 ^ 16)) with (65536 # 1) in L. pose proof (Qabs_nonneg area). lra.
Qed.

Lemma inverse_small : Qabs (1 / area) <= inject_Z (2 ^ 17).
Proof.
  destruct area_size as [L _]. assert (P : 0 < Qabs area).
  { change (inject_Z (2 ^ 16)) with (65536 # 1) in L. pose proof (Qabs_nonneg area). lra. }
  assert (E : Qabs (1 / area) == 1 / Qabs area) by (unfold Qdiv; rewrite !Qmult_1_l; apply Qabs_Qinv).
  rewrite E. apply Qle_shift_div_r; [assumption|]. change (inject_Z (2 ^ 17)) with (131072 # 1).
  change (inject_Z (2 ^ 16)) with (65536 # 1) in L. lra.
Qed.

Lemma inverse_sized : sized 37 (Qabs (1 / area)).
Proof.
  destruct area_sized as [L U]. pose proof (two_at_least_1 37). assert (P : 0 < Qabs area) by nra.
  assert (E : Qabs (1 / area) == / Qabs area) by (unfold Qdiv; rewrite Qmult_1_l; apply Qabs_Qinv).
  unfold sized. rewrite E. set (t := two 37) in *. clearbody t. set (s := Qabs area) in *. clearbody s. split.
  - setoid_replace (/ s * t) with (t / s) by (field; lra). apply Qle_shift_div_l; lra.
  - setoid_replace (/ s) with (1 / s) by (field; lra). apply Qle_shift_div_r; lra.
Qed.

Lemma pa_rounded : Qabs (pa - 1 / area) <= u * Qabs (1 / area).
Proof.
  assert (E : 1 / computed_area == 1 / area) by (rewrite area_is_exact; reflexivity).
  assert (N : normal <= Qabs (1 / computed_area)) by (rewrite E; exact (sized_normal 37 _ ltac:(lia) inverse_sized)).
  pose proof (relative_rounding _ N) as R. rewrite E in R at 2 3. exact R.
Qed.

(** ** T *)

Variables (width height : Z).
Hypothesis (HW : (0 <= width <= 2 ^ 19)%Z) (HH : (0 <= height <= 2 ^ 19)%Z).

Lemma pixels_weight z : (Z.abs z < 2 ^ 33)%Z -> weight 0 34 (Qabs (pixels z)) (Qabs (pixels z)).
Proof.
  intros B. split; [apply Qabs_nonneg | apply approx_refl | apply is_float_abs, (fl_float _ nearest_rounds) |].
  assert (E : Qabs (pixels z) == inject_Z (Z.abs z) * (1 # 256)).
  { rewrite pixels_exact by lia. assert (P : pow2 (-8) == 1 # 256) by (apply Qeq_bool_iff; vm_compute; reflexivity).
    rewrite P, Qabs_Qmult. reflexivity. }
  destruct (Z.eq_dec z 0) as [-> | N]; [left; rewrite E; reflexivity | right].
  assert (B1 : 1 <= inject_Z (Z.abs z)) by (change 1 with (inject_Z 1); rewrite <- Zle_Qle; lia).
  assert (B2 : inject_Z (Z.abs z) <= inject_Z (2 ^ 33)) by (rewrite <- Zle_Qle; lia).
  unfold sized, two. rewrite E. change (inject_Z (2 ^ Z.of_nat 34)) with (17179869184 # 1).
  change (inject_Z (2 ^ 33)) with (8589934592 # 1) in B2. split; lra.
Qed.

Lemma pa_weight : weight 1 38 (Qabs (1 / area)) (Qabs pa).
Proof.
  pose proof (rounding_of_abs _ _ pa_rounded) as S.
  split; [apply Qabs_nonneg | | apply is_float_abs, (fl_float _ nearest_rounds) | right].
  - apply (approx_round 0 _ _ _ S). apply approx_refl.
  - exact (sized_round 37 _ _ S inverse_sized).
Qed.

Definition exact_growth : Q :=
  1 + 2 * ((Qabs y1 + Qabs y2) * (Qabs X0 + inject_Z width) + (Qabs x1 + Qabs x2) * (Qabs Y0 + inject_Z height)) * Qabs (1 / area).

Lemma growth_weight : weight 8 119 exact_growth (growth_of (frame_of a b c x0 y0) width height).
Proof.
  unfold growth_of, frame_of, exact_growth. cbv zeta.
  pose proof (weight_add _ nearest_rounds 0 34 _ _ _ _ ltac:(lia) (pixels_weight dy1 ltac:(lia)) (pixels_weight dy2 ltac:(lia))) as A1.
  pose proof (weight_add _ nearest_rounds 0 34 _ _ _ _ ltac:(lia) (pixels_weight dx1 ltac:(lia)) (pixels_weight dx2 ltac:(lia))) as A2.
  pose proof (weight_add _ nearest_rounds 0 34 _ _ _ _ ltac:(lia) (pixels_weight _ (Z.lt_trans _ (2 ^ 32) (2 ^ 33) DX ltac:(reflexivity)))
    (weight_exact 34 width ltac:(cbn; lia))) as B1.
  pose proof (weight_add _ nearest_rounds 0 34 _ _ _ _ ltac:(lia) (pixels_weight _ (Z.lt_trans _ (2 ^ 32) (2 ^ 33) DY ltac:(reflexivity)))
    (weight_exact 34 height ltac:(cbn; lia))) as B2.
  pose proof (weight_mul _ nearest_rounds 1 36 1 36 _ _ _ _ ltac:(lia) A1 B1) as P1.
  pose proof (weight_mul _ nearest_rounds 1 36 1 36 _ _ _ _ ltac:(lia) A2 B2) as P2.
  pose proof (weight_add _ nearest_rounds 3 73 _ _ _ _ ltac:(lia) P1 P2) as S.
  pose proof (weight_mul _ nearest_rounds 0 2 4 75 _ _ _ _ ltac:(lia) (weight_exact 2 2 ltac:(cbn; lia)) S) as D.
  pose proof (weight_mul _ nearest_rounds 5 78 1 38 _ _ _ _ ltac:(lia) D pa_weight) as E.
  pose proof (weight_weaken 0 2 7 117 _ _ ltac:(lia) ltac:(lia) (weight_exact 2 1 ltac:(split; [discriminate | reflexivity]))) as O.
  exact (weight_add _ nearest_rounds 7 117 _ _ _ _ ltac:(lia) O E).
Qed.

Section T.
Variables (v0 v1 v2 c0 c1 c2 M t : Q).
Hypothesis (N0 : near 2 t M v0 c0) (N1 : near 2 t M v1 c1) (N2 : near 2 t M v2 c2).
(** M is the largest magnitude, not only above it. *)
Hypothesis HM : M <= larger (larger (Qabs v0) (Qabs v1)) (Qabs v2).
Hypothesis BT : t <= 1 # 2 ^ 1000.

Notation g := (growth_of (frame_of a b c x0 y0) width height).
Notation m := (larger (larger (Qabs c0) (Qabs c1)) (Qabs c2)).

Lemma most_near : M <= (m + t) * (1 + (1 # 2 ^ 50)).
Proof.
  pose proof (larger_spec (larger (Qabs c0) (Qabs c1)) (Qabs c2)) as (L1 & L2 & _).
  pose proof (larger_spec (Qabs c0) (Qabs c1)) as (L3 & L4 & _).
  assert (H : forall v c, near 2 t M v c -> Qabs c <= m -> Qabs v <= m + drift 2 * M + t).
  { intros v k (E & _ & _) K. setoid_replace v with (k + - (k - v)) at 1 by ring.
    pose proof (Qabs_triangle k (- (k - v))) as Tr. rewrite Qabs_opp in Tr. lra. }
  pose proof (H _ _ N0 ltac:(lra)) as H0. pose proof (H _ _ N1 ltac:(lra)) as H1. pose proof (H _ _ N2 ltac:(lra)) as H2.
  assert (K : M <= m + drift 2 * M + t).
  { apply (Qle_trans _ _ _ HM). destruct (larger_spec (larger (Qabs v0) (Qabs v1)) (Qabs v2)) as (_ & _ & [-> | ->]); [|assumption].
    destruct (larger_spec (Qabs v0) (Qabs v1)) as (_ & _ & [-> | ->]); assumption. }
  assert (D : drift 2 <= 1 # 2 ^ 51) by (apply Qle_bool_iff; vm_compute; reflexivity).
  destruct (near_size _ _ _ _ _ N0) as [M0 _]. assert (F : drift 2 * M <= (1 # 2 ^ 51) * M) by (apply Qmult_le_compat_r; assumption).
  set (k := m + t) in *. assert (Q : M * (1 - (1 # 2 ^ 51)) <= k) by (unfold k in *; lra). clearbody k.
  change (1 # 2 ^ 51) with (1 # 2251799813685248) in *. change (1 # 2 ^ 50) with (1 # 1125899906842624). lra.
Qed.

Lemma growth_near : exact_growth <= g * (1 + drift 8) /\ 0 <= g <= inject_Z (2 ^ 119) /\ 0 <= exact_growth.
Proof.
  pose proof growth_weight as [E A F S]. pose proof (approx_at _ _ _ A E) as (P & L & _).
  destruct (low_drift 8 ltac:(lia)) as [B _]. pose proof (low_bounds 8). split; [|split; [split; [assumption|] | assumption]].
  - apply Qle_trans with (exact_growth * ((1 + drift 8) * low 8)).
    + setoid_replace exact_growth with (exact_growth * 1) at 1 by ring. rewrite !(Qmult_comm exact_growth).
      apply Qmult_le_compat_r; assumption.
    + setoid_replace (exact_growth * ((1 + drift 8) * low 8)) with (low 8 * exact_growth * (1 + drift 8)) by ring.
      apply Qmult_le_compat_r; [assumption | pose proof (drift_positive 8); lra].
  - destruct S as [Z | [_ U]]; [rewrite Z; discriminate | exact U].
Qed.

Theorem size_is_near x y : Qabs x <= inject_Z width -> Qabs y <= inject_Z height ->
  0 <= size_of c0 c1 c2 g /\
  growth x1 y1 x2 y2 area X0 Y0 M x y <= size_of c0 c1 c2 g * (1 + (1 # 2 ^ 30)) + (1 # 2 ^ 800).
Proof.
  intros Wx Hy. destruct growth_near as (G & G0 & E0). destruct N0 as (_ & _ & T0). destruct (near_size _ _ _ _ _ N0) as [M0 _].
  exact (size_arithmetic M m t g exact_growth _ M0 (larger_not_negative _ _ (Qabs_nonneg c2)) T0 BT G0 E0 G most_near
    (growth_at_most x1 y1 x2 y2 area X0 Y0 M x y _ _ M0 Wx Hy)).
Qed.
End T.

Lemma pixels_at_most z k : (Z.abs z <= 256 * 2 ^ k)%Z -> (0 <= k <= 40)%Z -> Qabs (pixels z) <= inject_Z (2 ^ k).
Proof.
  intros B K. assert (L : (2 ^ k <= 2 ^ 40)%Z) by (apply Z.pow_le_mono_r; lia).
  assert (E : Qabs (pixels z) == inject_Z (Z.abs z) * (1 # 256)).
  { rewrite (Qabs_wd _ _ (pixels_exact z ltac:(lia))). assert (P : pow2 (-8) == 1 # 256) by (apply Qeq_bool_iff; vm_compute; reflexivity).
    rewrite P, Qabs_Qmult. reflexivity. }
  rewrite E. assert (I : inject_Z (Z.abs z) <= 256 * inject_Z (2 ^ k)).
  { change 256 with (inject_Z 256). rewrite <- inject_Z_mult, <- Zle_Qle. exact B. }
  lra.
Qed.

(** A plane at a pixel or a sample lies within the bound that the code computes. *)
Theorem tile_plane v0 v1 v2 c0 c1 c2 M t x y : near 2 t M v0 c0 -> near 2 t M v1 c1 -> near 2 t M v2 c2 ->
  M <= larger (larger (Qabs v0) (Qabs v1)) (Qabs v2) -> t <= 1 # 2 ^ 1000 ->
  Qabs x <= inject_Z width -> Qabs y <= inject_Z height ->
  let f := frame_of a b c x0 y0 in let p := plane_of f c0 c1 c2 in
  Qabs (plane_at p x y - exact_value x1 y1 x2 y2 area X0 Y0 v0 v1 v2 x y) <=
    computed_error 4 11 18 126 (computed_size (at_start p) (to_right p) (to_below p) x y)
      (size_of c0 c1 c2 (growth_of f width height)).
Proof.
  intros N0 N1 N2 HM BT Wx Hy. destruct (size_is_near v0 v1 v2 c0 c1 c2 M t N0 N1 N2 HM BT x y Wx Hy) as [Tp HT].
  assert (Ax : Qabs x <= inject_Z (2 ^ 19)) by (apply (Qle_trans _ _ _ Wx); rewrite <- Zle_Qle; lia).
  assert (Ay : Qabs y <= inject_Z (2 ^ 19)) by (apply (Qle_trans _ _ _ Hy); rewrite <- Zle_Qle; lia).
  assert (BT' : t <= 1 # 2 ^ 900) by (apply (Qle_trans _ _ _ BT); discriminate).
  apply computed_error_holds; [exact Tp|].
  exact (plane_error x1 y1 x2 y2 area pa X0 Y0 pa_rounded v0 v1 v2 c0 c1 c2 M t N0 N1 N2
    (pixels_at_most dx1 18 ltac:(lia) ltac:(lia)) (pixels_at_most dy1 18 ltac:(lia) ltac:(lia))
    (pixels_at_most dx2 18 ltac:(lia) ltac:(lia)) (pixels_at_most dy2 18 ltac:(lia) ltac:(lia)) inverse_small
    (pixels_at_most (x0 * 256 + 128 - X a) 24 ltac:(lia) ltac:(lia))
    (pixels_at_most (y0 * 256 + 128 - Y a) 24 ltac:(lia) ltac:(lia)) BT' x y _ Ax Ay Tp HT).
Qed.

(** S of a plane through values of at most M. *)
Lemma size_of_plane v0 v1 v2 c0 c1 c2 M t x y : near 2 t M v0 c0 -> near 2 t M v1 c1 -> near 2 t M v2 c2 -> t <= 1 # 2 ^ 1000 ->
  Qabs x <= inject_Z width -> Qabs y <= inject_Z height ->
  let p := plane_of (frame_of a b c x0 y0) c0 c1 c2 in
  size (at_start p) (to_right p) (to_below p) x y <= inject_Z (2 ^ 64) * M + 1.
Proof.
  intros N0 N1 N2 BT Wx Hy. assert (BT' : t <= 1 # 2 ^ 900) by (apply (Qle_trans _ _ _ BT); discriminate).
  assert (Ax : Qabs x <= inject_Z (2 ^ 19)) by (apply (Qle_trans _ _ _ Wx); rewrite <- Zle_Qle; lia).
  assert (Ay : Qabs y <= inject_Z (2 ^ 19)) by (apply (Qle_trans _ _ _ Hy); rewrite <- Zle_Qle; lia).
  exact (size_at_most x1 y1 x2 y2 area pa X0 Y0 pa_rounded v0 v1 v2 c0 c1 c2 M t N0 N1 N2
    (pixels_at_most dx1 18 ltac:(lia) ltac:(lia)) (pixels_at_most dy1 18 ltac:(lia) ltac:(lia))
    (pixels_at_most dx2 18 ltac:(lia) ltac:(lia)) (pixels_at_most dy2 18 ltac:(lia) ltac:(lia)) inverse_small
    (pixels_at_most (x0 * 256 + 128 - X a) 24 ltac:(lia) ltac:(lia))
    (pixels_at_most (y0 * 256 + 128 - Y a) 24 ltac:(lia) ltac:(lia)) BT' x y Ax Ay).
Qed.
End Corners.

(** ** Depths and attributes *)

(** What is proved of: edges below 2^bits px, an area, the first corner within 2^24 px of the first pixel, and a box of at most
    2^19 px. A box of pixels that lie in the triangle's own has the last two if the edges are short. *)
Definition in_domain (bits : positive) (a b c : point) (x0 y0 width height : Z) : Prop :=
  let short from to := (Z.abs (to - from) < 2 ^ (Z.pos bits + 8))%Z in
  (short (X a) (X b) /\ short (Y a) (Y b) /\ short (X a) (X c) /\ short (Y a) (Y c)) /\
  ((X b - X a) * (Y c - Y a) - (X c - X a) * (Y b - Y a) <> 0)%Z /\
  ((Z.abs (x0 * 256 + 128 - X a) < 2 ^ 32)%Z /\ (Z.abs (y0 * 256 + 128 - Y a) < 2 ^ 32)%Z) /\
  (0 <= width <= 2 ^ 19)%Z /\ (0 <= height <= 2 ^ 19)%Z.

(** The plane through the three values, at (x, y) pixels from the centre of the first pixel. *)
Definition exact_plane (a b c : point) (x0 y0 : Z) (v0 v1 v2 x y : Q) : Q :=
  exact_value (pixels (X b - X a)) (pixels (Y b - Y a)) (pixels (X c - X a)) (pixels (Y c - Y a)) (area a b c)
    (pixels (x0 * 256 + 128 - X a)) (pixels (y0 * 256 + 128 - Y a)) v0 v1 v2 x y.

Theorem exact_at_corners x1 y1 x2 y2 X0 Y0 v0 v1 v2 : ~ x1 * y2 - x2 * y1 == 0 ->
  let at_corner x y := exact_value x1 y1 x2 y2 (x1 * y2 - x2 * y1) X0 Y0 v0 v1 v2 (x - X0) (y - Y0) in
  at_corner 0 0 == v0 /\ at_corner x1 y1 == v1 /\ at_corner x2 y2 == v2.
Proof.
  intros H. cbv zeta. unfold exact_value, exact_right, exact_down. repeat split; field; exact H.
Qed.

Lemma near_wider n t t' R R' x x' : t <= t' -> R <= R' -> near n t R x x' -> near n t' R' x x'.
Proof.
  intros T L (E & B & T0). pose proof (drift_positive n) as D.
  split; [|split; [exact (Qle_trans _ _ _ B L) | exact (Qle_trans _ _ _ T0 T)]].
  assert (drift n * R <= drift n * R') by (rewrite !(Qmult_comm (drift n)); apply Qmult_le_compat_r; assumption). lra.
Qed.

Lemma near_itself n v : near n 0 (Qabs v) v v.
Proof.
  split; [|split; apply Qle_refl]. setoid_replace (v - v) with 0 by ring. change (Qabs 0) with 0.
  pose proof (drift_positive n). pose proof (Qabs_nonneg v). assert (0 <= drift n * Qabs v) by (apply Qmult_le_0_compat; assumption). lra.
Qed.

Lemma each_at_most v0 v1 v2 (m := larger (larger (Qabs v0) (Qabs v1)) (Qabs v2)) : Qabs v0 <= m /\ Qabs v1 <= m /\ Qabs v2 <= m.
Proof.
  destruct (larger_spec (larger (Qabs v0) (Qabs v1)) (Qabs v2)) as (A & B & _). destruct (larger_spec (Qabs v0) (Qabs v1)) as (C & D & _).
  fold m in A, B. split; [lra | split; lra].
Qed.

Theorem tile_values_near v0 v1 v2 c0 c1 c2 a b c x0 y0 width height x y : in_domain 18 a b c x0 y0 width height ->
  let near_value v k := near 2 (1 # 2 ^ 1000) (Qabs v) v k in near_value v0 c0 -> near_value v1 c1 -> near_value v2 c2 ->
  Qabs x <= inject_Z width -> Qabs y <= inject_Z height ->
  let f := frame_of a b c x0 y0 in let p := plane_of f c0 c1 c2 in
  Qabs (plane_at p x y - exact_plane a b c x0 y0 v0 v1 v2 x y) <=
    computed_error 4 11 18 126 (computed_size (at_start p) (to_right p) (to_below p) x y)
      (size_of c0 c1 c2 (growth_of f width height)).
Proof.
  intros ((D1 & D2 & D3 & D4) & Area & (DX & DY) & HW & HH). cbv zeta. intros N0 N1 N2 Wx Hy.
  destruct (each_at_most v0 v1 v2) as (M0 & M1 & M2). assert (T : 1 # 2 ^ 1000 <= 1 # 2 ^ 1000) by apply Qle_refl.
  exact (tile_plane a b c x0 y0 D1 D2 D3 D4 Area DX DY width height HW HH v0 v1 v2 c0 c1 c2 _ _ x y
    (near_wider _ _ _ _ _ _ _ T M0 N0) (near_wider _ _ _ _ _ _ _ T M1 N1) (near_wider _ _ _ _ _ _ _ T M2 N2) (Qle_refl _) T Wx Hy).
Qed.

(** 1/w over the largest, and an attribute times that. *)
Lemma share_near s most : inv_w s -> inv_w most -> near 2 (1 # 2 ^ 1000) (Qabs (s / most)) (s / most) (nearest (s / most)).
Proof.
  intros Hs Hm. pose proof (relative_weight _ nearest_rounds s most Hs Hm) as [E A _ _]. pose proof (approx_error 1 _ _ ltac:(lia) A) as R.
  apply (near_wider 2 0 _ (Qabs (s / most))); [discriminate | apply Qle_refl|].
  apply (near_weaken 1 2); [lia|].
  split; [apply (Qle_trans _ _ _ R); set (e := drift 1 * Qabs (s / most)); clearbody e; lra | split; apply Qle_refl].
Qed.

Lemma over_near v s most : inv_w s -> inv_w most ->
  near 2 (1 # 2 ^ 1000) (Qabs (v * (s / most))) (v * (s / most)) (nearest (v * nearest (s / most))).
Proof.
  intros Hs Hm. pose proof (relative_least s most Hs Hm) as L. pose proof (relative_weight _ nearest_rounds s most Hs Hm) as [E _ _ _].
  assert (N : normal <= Qabs (s / most)).
  { rewrite Qabs_pos by assumption. assert (T : normal * two 400 <= 1) by (apply Qle_bool_iff; vm_compute; reflexivity).
    pose proof (two_at_least_1 400). set (k := two 400) in *. set (q := s / most) in *. clearbody k q.
    destruct (Qlt_le_dec q normal) as [B|]; [exfalso | assumption]. assert (q * k < normal * k) by (apply Qmult_lt_compat_r; lra). lra. }
  pose proof (relative_rounding _ N) as R.
  pose proof (near_by_rounded 0 0 _ _ _ (s / most) (nearest (s / most)) (Qabs (s / most)) ltac:(lia) R (Qle_refl _) (near_itself 0 v)) as P.
  pose proof (near_round 1 _ _ _ _ ltac:(lia) P) as F. refine (near_wider _ _ _ _ _ _ _ _ _ F).
  - setoid_replace (2 * (2 * (0 * Qabs (s / most))) + eta) with eta by ring. apply Qle_bool_iff. vm_compute. reflexivity.
  - rewrite Qabs_Qmult. apply Qle_refl.
Qed.

Lemma nearest32_float x : is_float (nearest32 x).
Proof.
  assert (P : forall z, is_float (nearest32_positive z)).
  { intros z. unfold nearest32_positive. set (m := whole _). assert (H : (0 <= last_bit32 z + 1074)%Z) by (unfold last_bit32; lia).
    exists (m * 2 ^ (last_bit32 z + 1074))%Z. rewrite inject_Z_mult, <- pow2_integer by assumption. rewrite pow2_add.
    assert (E : pow2 1074 * (1 # 2 ^ 1074) == 1) by (apply Qeq_bool_iff; vm_compute; reflexivity).
    setoid_replace (inject_Z m * (pow2 (last_bit32 z) * pow2 1074) * (1 # 2 ^ 1074)) with
      (inject_Z m * pow2 (last_bit32 z) * (pow2 1074 * (1 # 2 ^ 1074))) by ring. rewrite E. ring. }
  unfold nearest32. destruct (Qeq_bool x 0); [exists 0%Z; reflexivity|]. destruct (Qle_bool 0 x); [apply P | apply is_float_opp, P].
Qed.

Lemma computed_error_least s r d x y T : 0 <= T -> 1 # 2 ^ 127 <= computed_error 4 11 18 126 (computed_size s r d x y) T.
Proof.
  intros Tp. apply computed_error_holds; [exact Tp|]. unfold plane_bound, size. pose proof (Qabs_nonneg s).
  pose proof (Qabs_nonneg (nearest32 (r * x))). pose proof (Qabs_nonneg (nearest32 (d * y))).
  set (k := Qabs s + Qabs (nearest32 (r * x)) + Qabs (nearest32 (d * y))). assert (K : 0 <= k) by (unfold k; lra). clearbody k.
  change (inject_Z (Z.pos 4)) with 4. change (inject_Z (Z.pos 11)) with 11. change (1 # 2 ^ 20) with (1 # 1048576).
  set (o := 1 # 2 ^ 127). clearbody o. unfold w, u. lra.
Qed.

Lemma quotient_arithmetic n q n' q' en eq : is_float eq -> is_float q' -> 1 # 2 ^ 127 <= en -> 1 # 2 ^ 127 <= eq ->
  Qabs (n' - n) <= en -> Qabs (q' - q) <= eq -> eq < q' -> q' <= inject_Z (2 ^ 80) ->
  Qabs (computed_quotient n' q' - n / q) <= computed_quotient_error 2 18 126 en eq n' q'.
Proof.
  intros Fe Fq Ln Lq En Eq P Most.
  apply computed_quotient_holds; [assumption | assumption | | assumption | assumption | assumption |].
  - apply (Qle_trans _ (1 # 2 ^ 127)); [discriminate | assumption].
  - exact (quotient_error n q n' q' en eq En Eq P Most).
Qed.

Lemma size_not_negative c0 c1 c2 g : 0 <= g -> 0 <= size_of c0 c1 c2 g.
Proof.
  intros G. apply (fl_sign _ nearest_rounds). apply Qmult_le_0_compat; [apply larger_not_negative, Qabs_nonneg | exact G].
Qed.

(** S as the code computes it, in f64, and S. *)
Lemma computed_size_near s r d x y : size s r d x y <= computed_size s r d x y * (1 + (1 # 2 ^ 40)) + 1 /\
  computed_size s r d x y <= size s r d x y * (1 + (1 # 2 ^ 40)) + 1.
Proof.
  unfold size, computed_size. pose proof (Qabs_nonneg s) as I. pose proof (Qabs_nonneg (nearest32 (r * x))) as J.
  pose proof (Qabs_nonneg (nearest32 (d * y))) as K.
  set (i := Qabs s) in *. set (j := Qabs (nearest32 (r * x))) in *. set (k := Qabs (nearest32 (d * y))) in *. clearbody i j k.
  pose proof (fl_absolute _ nearest_rounds (i + j)) as A. pose proof (fl_sign _ nearest_rounds (i + j) ltac:(lra)) as P.
  rewrite (Qabs_pos (i + j)) in A by lra. set (m := nearest (i + j)) in *. clearbody m.
  pose proof (fl_absolute _ nearest_rounds (m + k)) as B. rewrite (Qabs_pos (m + k)) in B by lra. set (o := nearest (m + k)) in *. clearbody o.
  apply Qabs_Qle_condition in A, B. assert (E : 0 <= eta <= 1 # 1024) by (split; [discriminate | apply Qle_bool_iff; vm_compute; reflexivity]).
  set (h := eta) in *. clearbody h. change (1 # 2 ^ 40) with (1 # 1099511627776). unfold u in *. split; lra.
Qed.

(** Where the S that the code computes is below 2^127, nothing that it was computed from left f32, nor does the value. *)
Theorem tile_sums_fit s r d x y : computed_size s r d x y < inject_Z (2 ^ 127) ->
  Qabs s <= largest32 /\ Qabs (nearest32 (r * x)) <= largest32 /\ Qabs (nearest32 (d * y)) <= largest32 /\
  Qabs (nearest32 (s + nearest32 (d * y))) <= largest32 /\ Qabs (at_pixel s r d x y) <= largest32.
Proof.
  intros H. apply plane_fits. destruct (computed_size_near s r d x y) as [L _].
  assert (C : inject_Z (2 ^ 127) * (1 + (1 # 2 ^ 40)) + 1 <= inject_Z (2 ^ 127 + 2 ^ 100)) by (apply Qle_bool_iff; vm_compute; reflexivity).
  set (k := inject_Z (2 ^ 127)) in *. set (l := inject_Z (2 ^ 127 + 2 ^ 100)) in *. clearbody k l.
  change (1 # 2 ^ 40) with (1 # 1099511627776) in *. lra.
Qed.

(** The plane of 1/w, over the largest of the three, is far below 2^80. *)
Theorem shares_at_most a b c x0 y0 width height w0 w1 w2 most x y : in_domain 18 a b c x0 y0 width height ->
  inv_w w0 -> inv_w w1 -> inv_w w2 -> inv_w most -> w0 <= most -> w1 <= most -> w2 <= most ->
  Qabs x <= inject_Z width -> Qabs y <= inject_Z height ->
  plane_at (plane_of (frame_of a b c x0 y0) (nearest (w0 / most)) (nearest (w1 / most)) (nearest (w2 / most))) x y <= inject_Z (2 ^ 80).
Proof.
  intros ((D1 & D2 & D3 & D4) & Area & (DX & DY) & HW & HH) H0 H1 H2 Hm L0 L1 L2 Wx Hy.
  destruct (inv_w_weight _ Hm) as [Pm _]. assert (T : 1 # 2 ^ 1000 <= 1 # 2 ^ 1000) by apply Qle_refl.
  assert (N : forall s, inv_w s -> s <= most -> near 2 (1 # 2 ^ 1000) 1 (s / most) (nearest (s / most))).
  { intros s Hs L. destruct (inv_w_weight _ Hs) as [Ps _]. apply (near_wider _ _ _ _ _ _ _ T) with (2 := share_near s most Hs Hm).
    rewrite Qabs_pos by (apply Qle_shift_div_l; lra). apply Qle_shift_div_r; lra. }
  pose proof (size_of_plane a b c x0 y0 D1 D2 D3 D4 Area DX DY width height HW HH _ _ _ _ _ _ 1 _ x y (N _ H0 L0) (N _ H1 L1) (N _ H2 L2) T Wx Hy) as S.
  cbv zeta in S. set (p := plane_of _ _ _ _) in *. clearbody p.
  pose proof (plane_at_most (at_start p) (to_right p) (to_below p) x y : Qabs (plane_at p x y) <= _) as A.
  pose proof (Qle_Qabs (plane_at p x y)). set (o := size _ _ _ x y) in *. clearbody o. set (v := plane_at p x y) in *. clearbody v.
  change (inject_Z (2 ^ 64)) with (18446744073709551616 # 1) in S. change (inject_Z (2 ^ 80)) with (1208925819614629174706176 # 1). lra.
Qed.

(** Attributes of at most 2^62 have a bound: S of their plane is below 2^127. *)
Theorem small_attributes_fit a b c x0 y0 width height w0 w1 w2 most v0 v1 v2 x y : in_domain 18 a b c x0 y0 width height ->
  inv_w w0 -> inv_w w1 -> inv_w w2 -> inv_w most -> w0 <= most -> w1 <= most -> w2 <= most ->
  Qabs v0 <= inject_Z (2 ^ 62) -> Qabs v1 <= inject_Z (2 ^ 62) -> Qabs v2 <= inject_Z (2 ^ 62) ->
  Qabs x <= inject_Z width -> Qabs y <= inject_Z height ->
  let over v s := nearest (v * nearest (s / most)) in
  let p := plane_of (frame_of a b c x0 y0) (over v0 w0) (over v1 w1) (over v2 w2) in
  computed_size (at_start p) (to_right p) (to_below p) x y < inject_Z (2 ^ 127).
Proof.
  intros ((D1 & D2 & D3 & D4) & Area & (DX & DY) & HW & HH) H0 H1 H2 Hm L0 L1 L2 B0 B1 B2 Wx Hy. cbv zeta.
  destruct (inv_w_weight _ Hm) as [Pm _]. assert (T : 1 # 2 ^ 1000 <= 1 # 2 ^ 1000) by apply Qle_refl.
  assert (N : forall v s, inv_w s -> s <= most -> Qabs v <= inject_Z (2 ^ 62) ->
    near 2 (1 # 2 ^ 1000) (inject_Z (2 ^ 62)) (v * (s / most)) (nearest (v * nearest (s / most)))).
  { intros v s Hs L B. destruct (inv_w_weight _ Hs) as [Ps _]. apply (near_wider _ _ _ _ _ _ _ T) with (2 := over_near v s most Hs Hm).
    assert (Q0 : 0 <= s / most) by (apply Qle_shift_div_l; lra). assert (Q1 : s / most <= 1) by (apply Qle_shift_div_r; lra).
    rewrite Qabs_Qmult, (Qabs_pos (s / most)) by assumption.
    destruct (product_le _ _ _ _ (conj (Qabs_nonneg v) B) (conj Q0 Q1)) as [_ P]. rewrite Qmult_1_r in P. exact P. }
  pose proof (size_of_plane a b c x0 y0 D1 D2 D3 D4 Area DX DY width height HW HH _ _ _ _ _ _ _ _ x y
    (N _ _ H0 L0 B0) (N _ _ H1 L1 B1) (N _ _ H2 L2 B2) T Wx Hy) as S.
  cbv zeta in S. set (p := plane_of _ _ _ _) in *. clearbody p. destruct (computed_size_near (at_start p) (to_right p) (to_below p) x y) as [_ U].
  assert (C : (inject_Z (2 ^ 64) * inject_Z (2 ^ 62) + 1) * (1 + (1 # 1099511627776)) + 1 < inject_Z (2 ^ 127)) by reflexivity.
  set (o := size _ _ _ x y) in *. set (z := computed_size _ _ _ x y) in *. clearbody o z. change (1 # 2 ^ 40) with (1 # 1099511627776) in U.
  set (k := inject_Z (2 ^ 64) * inject_Z (2 ^ 62)) in *. set (l := inject_Z (2 ^ 127)) in *. clearbody k l. lra.
Qed.

(** An attribute: the quotient of its plane and that of 1/w, wherever the code has a bound. *)
Theorem tile_attribute a b c x0 y0 width height w0 w1 w2 most v0 v1 v2 x y : in_domain 18 a b c x0 y0 width height ->
  inv_w w0 -> inv_w w1 -> inv_w w2 -> inv_w most -> w0 <= most -> w1 <= most -> w2 <= most ->
  Qabs x <= inject_Z width -> Qabs y <= inject_Z height -> let f := frame_of a b c x0 y0 in let growth := growth_of f width height in
  let s0 := nearest (w0 / most) in let s1 := nearest (w1 / most) in let s2 := nearest (w2 / most) in
  let c0 := nearest (v0 * s0) in let c1 := nearest (v1 * s1) in let c2 := nearest (v2 * s2) in
  let over := plane_of f c0 c1 c2 in let under := plane_of f s0 s1 s2 in
  let error p T := computed_error 4 11 18 126 (computed_size (at_start p) (to_right p) (to_below p) x y) T in
  let en := error over (size_of c0 c1 c2 growth) in let eq := error under (size_of s0 s1 s2 growth) in
  eq < plane_at under x y ->
  Qabs (computed_quotient (plane_at over x y) (plane_at under x y) -
        exact_plane a b c x0 y0 (v0 * (w0 / most)) (v1 * (w1 / most)) (v2 * (w2 / most)) x y /
        exact_plane a b c x0 y0 (w0 / most) (w1 / most) (w2 / most) x y) <=
    computed_quotient_error 2 18 126 en eq (plane_at over x y) (plane_at under x y).
Proof.
  intros D H0 H1 H2 Hm L0 L1 L2 Wx Hy. cbv zeta. intros P.
  assert (G : 0 <= growth_of (frame_of a b c x0 y0) width height).
  { destruct D as ((D1 & D2 & D3 & D4) & Area & (DX & DY) & HW & HH).
    destruct (growth_near a b c x0 y0 D1 D2 D3 D4 Area DX DY width height HW HH) as (_ & [G _] & _). exact G. }
  apply quotient_arithmetic.
  - apply (fl_float _ nearest_rounds).
  - apply nearest32_float.
  - apply computed_error_least, size_not_negative, G.
  - apply computed_error_least, size_not_negative, G.
  - exact (tile_values_near _ _ _ _ _ _ a b c x0 y0 width height x y D (over_near v0 w0 most H0 Hm) (over_near v1 w1 most H1 Hm)
      (over_near v2 w2 most H2 Hm) Wx Hy).
  - exact (tile_values_near _ _ _ _ _ _ a b c x0 y0 width height x y D (share_near w0 most H0 Hm) (share_near w1 most H1 Hm)
      (share_near w2 most H2 Hm) Wx Hy).
  - exact P.
  - exact (shares_at_most a b c x0 y0 width height w0 w1 w2 most x y D H0 H1 H2 Hm L0 L1 L2 Wx Hy).
Qed.

(** Where the code has a bound for a quotient that is below 2^127 in f64, its reciprocal and the quotient lie within f32. *)
Theorem tile_quotient_fits n q : 1 # 2 ^ 127 <= q -> q <= inject_Z (2 ^ 80) -> Qabs (nearest (n / q)) < inject_Z (2 ^ 127) ->
  Qabs (nearest32 (1 / q)) <= largest32 /\ Qabs (computed_quotient n q) <= largest32.
Proof.
  intros L U H. apply quotient_fits; [assumption | assumption |]. pose proof (lower_abs (n / q)) as A.
  assert (E : 0 <= eta <= 1) by (split; [discriminate | apply Qle_bool_iff; vm_compute; reflexivity]).
  assert (C : inject_Z (2 ^ 127) * (1 + (1 # 1099511627776)) + 2 <= inject_Z (2 ^ 127 + 2 ^ 100)) by (apply Qle_bool_iff; vm_compute; reflexivity).
  assert (K : 0 <= inject_Z (2 ^ 127)) by discriminate.
  set (z := Qabs (nearest (n / q))) in *. set (i := Qabs (n / q)) in *. set (h := eta) in *. clearbody z i h.
  set (k := inject_Z (2 ^ 127)) in *. set (l := inject_Z (2 ^ 127 + 2 ^ 100)) in *. clearbody k l. unfold u in A. lra.
Qed.

(** A depth. *)
Theorem tile_depth a b c x0 y0 width height z0 z1 z2 x y : in_domain 18 a b c x0 y0 width height ->
  Qabs x <= inject_Z width -> Qabs y <= inject_Z height ->
  let f := frame_of a b c x0 y0 in let p := plane_of f z0 z1 z2 in
  Qabs (plane_at p x y - exact_plane a b c x0 y0 z0 z1 z2 x y) <=
    computed_error 4 11 18 126 (computed_size (at_start p) (to_right p) (to_below p) x y)
      (size_of z0 z1 z2 (growth_of f width height)).
Proof.
  intros D Wx Hy. assert (N : forall v, near 2 (1 # 2 ^ 1000) (Qabs v) v v).
  { intros v. assert (T : 0 <= 1 # 2 ^ 1000) by discriminate. exact (near_wider 2 0 _ _ _ _ _ T (Qle_refl _) (near_itself 2 v)). }
  exact (tile_values_near z0 z1 z2 z0 z1 z2 a b c x0 y0 width height x y D (N z0) (N z1) (N z2) Wx Hy).
Qed.

(** Where the exact depth lies behind the nearest corner, taking the nearest corner's for what is nearer makes no error larger. *)
Theorem nearest_corner_is_harmless z corner exact : corner <= exact -> Qabs (larger z corner - exact) <= Qabs (z - exact).
Proof.
  intros H. destruct (larger_spec z corner) as (A & B & [E | E]); rewrite E in *; [apply Qle_refl|].
  rewrite (Qabs_neg (corner - exact)), (Qabs_neg (z - exact)) by lra. lra.
Qed.
