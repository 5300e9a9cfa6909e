(** The keys of depths in fixed formats (crates/render/src/pipeline/depth.rs): thresholds that are moved away from simple
    fractions, so that two depths which differ by rounding errors get one key there. *)
From Coq Require Import ZArith QArith Qabs Qround Lia Lqa.
From Rasterproof Require Import Rounding Nearest.
Open Scope Q_scope.

(** What is added before a number is cut to a whole one: 1/2, and a part of a step. *)
Definition half_and_more (parts : Q) (bits : Z) : Q := nearest ((1 # 2) + nearest (nearest (1 / parts) / inject_Z (2 ^ bits))).

(** DepthFormat::key with [steps] steps, for a depth from 0 to 1. *)
Definition key (parts : Q) (bits steps : Z) (depth : Q) : Z :=
  Qfloor (nearest (nearest (depth * inject_Z steps) + half_and_more parts bits)).

(** The key that a multiple of 2^-20 has in exact arithmetic. *)
Definition key_of_fraction (steps a : Z) : Z := ((3 * a * steps + 3 * 2 ^ 19 + 1) / (3 * 2 ^ 20))%Z.

Lemma floor_between q z : inject_Z z <= q -> q < inject_Z (z + 1) -> Qfloor q = z.
Proof.
  intros L U. pose proof (Qfloor_le q) as F. pose proof (Qlt_floor q) as G.
  assert (A : inject_Z (Qfloor q) < inject_Z (z + 1)) by lra. assert (B : inject_Z z < inject_Z (Qfloor q + 1)) by lra.
  rewrite <- Zlt_Qlt in A, B. lia.
Qed.

Lemma absolute x b : 0 <= x <= b -> Qabs (nearest x - x) <= u * b + eta.
Proof.
  intros H. pose proof (fl_absolute nearest nearest_rounds x) as A. rewrite (Qabs_pos x) in A by lra.
  assert (0 <= u) by discriminate. assert (u * x <= u * b) by (rewrite !(Qmult_comm u); apply Qmult_le_compat_r; lra). lra.
Qed.

Theorem keys_of_24_bits a depth : (0 <= a <= 2 ^ 20)%Z -> 0 <= depth <= 1 ->
  Qabs (depth - inject_Z a / inject_Z (2 ^ 20)) <= 1 # 2 ^ 46 ->
  key 3 20 (2 ^ 24 - 1) depth = key_of_fraction (2 ^ 24 - 1) a.
Proof.
  intros Ha Hd Near. unfold key, key_of_fraction. set (n := (3 * a * (2 ^ 24 - 1) + 3 * 2 ^ 19 + 1)%Z).
  pose proof (Z.div_mod n (3 * 2 ^ 20) ltac:(lia)) as D. pose proof (Z.mod_pos_bound n (3 * 2 ^ 20) ltac:(lia)) as M.
  set (z := (n / (3 * 2 ^ 20))%Z) in *. set (r := (n mod (3 * 2 ^ 20))%Z) in *.
  (* One more than a multiple of 3, so at least 1 above a whole number and 2 below the next. *)
  assert (R : (1 <= r <= 3 * 2 ^ 20 - 2)%Z) by (unfold n in D; lia).
  assert (Ideal : inject_Z a / inject_Z (2 ^ 20) * inject_Z (2 ^ 24 - 1) + (1 # 2) + (1 # 3 * 2 ^ 20) ==
    inject_Z z + inject_Z r * (1 # 3 * 2 ^ 20)).
  { setoid_replace (inject_Z z + inject_Z r * (1 # 3 * 2 ^ 20)) with (inject_Z n * (1 # 3 * 2 ^ 20)).
    - unfold n. rewrite !inject_Z_plus, !inject_Z_mult. change (inject_Z (2 ^ 20)) with (1048576 # 1).
      change (inject_Z (2 ^ 24 - 1)) with (16777215 # 1). change (inject_Z (2 ^ 19)) with (524288 # 1).
      change (inject_Z 3) with (3 # 1). change (inject_Z 1) with (1 # 1). change (1 # 3 * 2 ^ 20) with (1 # 3145728).
      set (x := inject_Z a). field.
    - rewrite D, inject_Z_plus, inject_Z_mult. change (inject_Z (3 * 2 ^ 20)) with (3145728 # 1).
      change (1 # 3 * 2 ^ 20) with (1 # 3145728). field. }
  assert (R1 : 1 <= inject_Z r) by (change 1 with (inject_Z 1); rewrite <- Zle_Qle; lia).
  assert (R2 : inject_Z r <= inject_Z (3 * 2 ^ 20 - 2)) by (rewrite <- Zle_Qle; lia).
  change (inject_Z (3 * 2 ^ 20 - 2)) with (3145726 # 1) in R2. change (1 # 3 * 2 ^ 20) with (1 # 3145728) in *.
  assert (Off : Qabs (half_and_more 3 20 - ((1 # 2) + (1 # 3145728))) <= 1 # 2 ^ 50) by (apply Qle_bool_iff; vm_compute; reflexivity).
  assert (Half : 0 <= half_and_more 3 20 <= 1) by (split; apply Qle_bool_iff; vm_compute; reflexivity).
  set (h := half_and_more 3 20) in *. clearbody h. change (inject_Z (2 ^ 24 - 1)) with (16777215 # 1) in *.
  set (f := inject_Z a / inject_Z (2 ^ 20)) in *. clearbody f.
  pose proof (absolute (depth * (16777215 # 1)) (16777216 # 1) ltac:(split; lra)) as P.
  assert (E1 : u * (16777216 # 1) + eta <= 1 # 2 ^ 28) by (apply Qle_bool_iff; vm_compute; reflexivity).
  assert (N1 : 0 <= nearest (depth * (16777215 # 1))) by (apply (fl_sign nearest nearest_rounds); lra).
  set (p := nearest (depth * (16777215 # 1))) in *. clearbody p.
  apply Qabs_Qle_condition in P, Near, Off. change (1 # 2 ^ 28) with (1 # 268435456) in E1.
  change (1 # 2 ^ 46) with (1 # 70368744177664) in Near. change (1 # 2 ^ 50) with (1 # 1125899906842624) in Off.
  set (e1 := u * (16777216 # 1) + eta) in *. clearbody e1.
  pose proof (absolute (p + h) (33554432 # 1) ltac:(split; lra)) as S.
  assert (E2 : u * (33554432 # 1) + eta <= 1 # 134217728) by (apply Qle_bool_iff; vm_compute; reflexivity).
  set (e2 := u * (33554432 # 1) + eta) in *. clearbody e2. set (s := nearest (p + h)) in *. clearbody s.
  apply Qabs_Qle_condition in S.
  apply floor_between; [|rewrite inject_Z_plus; change (inject_Z 1) with 1]; lra.
Qed.

(** With 32 bits the moved threshold is nearer to 1/2 than a rounding error: a last bit decides. *)
Theorem keys_of_32_bits_differ : key 3 20 (2 ^ 32 - 1) (1 # 2) <> key 3 20 (2 ^ 32 - 1) ((1 # 2) - u).
Proof. vm_compute. discriminate. Qed.
