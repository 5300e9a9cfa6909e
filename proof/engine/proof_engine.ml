(* proof-engine NAME: the extracted models behind the line protocol (docs/protocol.md), verbs T and L.
   Every decision about pixels is made in Model; what is written here by hand is text and the snap. *)

exception Refused of string

let round_half_even v =
  let below = Float.floor v in
  let part = v -. below in
  if part < 0.5 || (part = 0.5 && Float.rem below 2. = 0.) then below else below +. 1.

let number name word =
  match float_of_string_opt word with
  | Some v when Float.is_finite v -> v
  | Some v when Float.is_nan v -> raise (Refused (name ^ " is not a number (NaN)"))
  | Some _ -> raise (Refused (name ^ " is infinite"))
  | None -> raise (Refused (name ^ " is not a number"))

(* Multiplying by 256 is exact, so this rounds once, as grid::snap. *)
let snap name word =
  let v = round_half_even (number name word *. 256.) in
  if v < -2147483648. || v > 2147483647. then raise (Refused (name ^ " is outside the domain"));
  int_of_float v

let point name x y =
  { Model.x = Num.of_int (snap ("x" ^ name) x); y = Num.of_int (snap ("y" ^ name) y) }

(* The pixel that holds a position. *)
let pixel name x y =
  { Model.x = Num.of_int (snap ("x" ^ name) x asr 8); y = Num.of_int (snap ("y" ^ name) y asr 8) }

let side word =
  match int_of_string_opt word with
  | Some n when n >= 0 && n <= 16384 -> n
  | _ -> raise (Refused "the window is no window")

let window w h =
  let z = Num.of_int in
  { Model.x0 = z 0; y0 = z 0; x1 = z (side w); y1 = z (side h) }

(* No word of the models overflows: that is proved, so this answer is never given. *)
let held = function Some answer -> answer | None -> raise (Refused "a word overflows")

let spans engine a b c window =
  let spans =
    match engine with
    | "scanline" -> held (Model.scanline_words a b c window)
    | "edge-function" -> held (Model.edge_function_words a b c window)
    | "oracle" -> held (Model.oracle_words a b c window)
    | _ -> raise (Refused "unsupported")
  in
  List.map (fun ((y, x0), x1) -> [ Num.to_int y; Num.to_int x0; Num.to_int x1 ]) spans

let pixels engine a b window =
  let draw =
    match engine with
    | "dda" -> Model.dda_words
    | "bresenham" -> Model.bresenham_words
    | _ -> raise (Refused "unsupported")
  in
  List.map (fun p -> [ Num.to_int p.Model.x; Num.to_int p.Model.y ]) (held (draw a b window))

let line verb id items =
  let words = List.concat items |> List.map string_of_int in
  String.concat " " (verb :: id :: string_of_int (List.length items) :: words)

let answer engine words =
  let id = match words with _ :: id :: _ -> id | _ -> "-" in
  try
    match words with
    | [ "HELLO"; "1" ] ->
        let capability = if engine = "dda" || engine = "bresenham" then "line" else "coverage" in
        Printf.sprintf "HELLO 1 proof-%s %s" engine capability
    | [ "T"; _; w; h; x0; y0; x1; y1; x2; y2 ] ->
        let a = point "0" x0 y0 and b = point "1" x1 y1 and c = point "2" x2 y2 in
        line "C" id (spans engine a b c (window w h))
    | [ "L"; _; w; h; x0; y0; x1; y1 ] ->
        line "P" id (pixels engine (pixel "0" x0 y0) (pixel "1" x1 y1) (window w h))
    | _ -> raise (Refused "unsupported")
  with Refused reason -> Printf.sprintf "E %s %s" id reason

let () =
  let engine = if Array.length Sys.argv = 2 then Sys.argv.(1) else "" in
  if not (List.mem engine [ "scanline"; "edge-function"; "oracle"; "dda"; "bresenham" ]) then (
    prerr_endline "usage: proof-engine scanline|edge-function|oracle|dda|bresenham";
    exit 2);
  try
    while true do
      let words = String.split_on_char ' ' (input_line stdin) |> List.filter (( <> ) "") in
      if words <> [] then print_endline (answer engine words)
    done
  with End_of_file -> ()
