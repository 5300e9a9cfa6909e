(* Whole numbers of the model as Coq defines them: a sign and a list of bits. *)
open Model

let rec positive n =
  if n = 1 then XH else if n land 1 = 1 then XI (positive (n / 2)) else XO (positive (n / 2))

let of_int n = if n = 0 then Z0 else if n > 0 then Zpos (positive n) else Zneg (positive (-n))
let rec of_positive = function XH -> 1 | XO p -> 2 * of_positive p | XI p -> (2 * of_positive p) + 1
let to_int = function Z0 -> 0 | Zpos p -> of_positive p | Zneg p -> -of_positive p
