(* proof-values ENGINE REQUESTS ANSWERS: computes the depths and attributes of every fragment that an engine answered
   (docs/protocol.md, verbs I and F) again with the extracted models, and compares all bits. Zeros of either sign are
   equal: the models know one. The planes of tiles, and their bounds, are answered by crates/tiles/examples/planes.rs. *)
module M = Values_model

let fail format = Printf.ksprintf (fun text -> prerr_endline text; exit 1) format

(* Every finite float is a whole number times a power of two. *)
let of_float v =
  let mantissa, exponent = Float.frexp v in
  let whole = Z.of_float (Float.ldexp mantissa 53) and shift = exponent - 53 in
  if shift >= 0 then { M.qnum = Z.shift_left whole shift; qden = Z.one }
  else { M.qnum = whole; qden = Z.shift_left Z.one (-shift) }

let to_float { M.qnum; qden } =
  if Z.sign qnum = 0 then 0.
  else
    let zeros = Z.trailing_zeros qnum in
    Float.ldexp (Z.to_float (Z.shift_right qnum zeros)) (zeros - Z.trailing_zeros qden)

let round_half_even v =
  let below = Float.floor v in
  let part = v -. below in
  if part < 0.5 || (part = 0.5 && Float.rem below 2. = 0.) then below else below +. 1.

let subpixels v = Z.of_float (round_half_even (v *. 256.))

(* One corner for each attribute. *)
let corner x y z w value =
  { M.position = { M.x = subpixels x; y = subpixels y }; depth = of_float z;
    inv_w_of = M.rounded_inverse (of_float w); attribute = of_float value }

let rec fragments = function
  | x :: y :: z :: a :: b :: rest -> (int_of_float x, int_of_float y, [ z; a; b ]) :: fragments rest
  | _ -> []

let words line = String.split_on_char ' ' (String.trim line)

(* Depth and attribute at a pixel of a window. *)
let whole engine _ _ p q r x y =
  let depth, value = engine p q r x y in
  (to_float depth, to_float value)

let planes pick width height p q r x y =
  let number = function None -> Float.infinity | Some answer -> to_float (pick answer) in
  let depth, value = M.tile_values width height p q r x y in
  (number depth, number value)

let () =
  let engine, requests, answers =
    match Sys.argv with
    | [| _; "edge-function"; r; a |] -> (whole M.rounded_edge_function, r, a)
    | [| _; "scanline"; r; a |] -> (whole M.rounded_scanline, r, a)
    | [| _; "values"; r; a |] -> (planes fst, r, a)
    | [| _; "bounds"; r; a |] -> (planes snd, r, a)
    | _ -> fail "usage: proof-values edge-function|scanline|values|bounds REQUESTS ANSWERS"
  in
  let requests = open_in requests and answers = open_in answers in
  let compared = ref 0 in
  let check line answer =
    match (words line, words answer) with
    | "I" :: id :: width :: height :: corners, "F" :: id' :: _ :: found when id = id' ->
        let numbers = List.map float_of_string corners in
        let vertices =
          match numbers with
          | [ x0; y0; z0; w0; a0; b0; x1; y1; z1; w1; a1; b1; x2; y2; z2; w2; a2; b2 ] ->
              fun pick ->
                ( corner x0 y0 z0 w0 (pick (a0, b0)), corner x1 y1 z1 w1 (pick (a1, b1)),
                  corner x2 y2 z2 w2 (pick (a2, b2)) )
          | _ -> fail "request %s has other than 18 numbers" id
        in
        let firsts = vertices fst and seconds = vertices snd in
        let values (p, q, r) x y = engine (Z.of_string width) (Z.of_string height) p q r (Z.of_int x) (Z.of_int y) in
        List.iter
          (fun (x, y, found) ->
            let depth, a = values firsts x y in
            let _, b = values seconds x y in
            let expected = [ depth; a; b ] in
            if not (List.for_all2 Float.equal (List.map (( +. ) 0.) found) (List.map (( +. ) 0.) expected)) then
              fail "request %s, pixel %d %d: the engine has %s, the model %s" id x y
                (String.concat " " (List.map (Printf.sprintf "%h") found))
                (String.concat " " (List.map (Printf.sprintf "%h") expected));
            incr compared)
          (fragments (List.map float_of_string found))
    | _ -> fail "the engine answers %s with %s" line answer
  in
  (try
     while true do
       check (input_line requests) (input_line answers)
     done
   with End_of_file -> ());
  Printf.printf "%d\n" !compared
