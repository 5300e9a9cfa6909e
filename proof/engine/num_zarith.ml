(* Whole numbers of the model as Zarith's. *)
let of_int = Big_int_Z.big_int_of_int
let to_int = Big_int_Z.int_of_big_int
