(* Strict reading and printing of 64-bit numbers; OCaml's Int64 holds their bits. *)
open Proved

exception Malformed of string
let malformed format = Printf.ksprintf (fun text -> raise (Malformed text)) format

let bits word =
  let digits = word <> "" && String.for_all (fun c -> '0' <= c && c <= '9') word in
  if not digits || (word.[0] = '0' && word <> "0") then malformed "not a number: '%s'" word;
  match Int64.of_string_opt ("0u" ^ word) with
  | Some b -> b
  | None -> malformed "a number beyond 64 bits: '%s'" word

let rec positive bits =
  if bits = 1L then XH
  else
    let rest = positive (Int64.shift_right_logical bits 1) in
    if Int64.logand bits 1L = 1L then XI rest else XO rest
let number word = match bits word with 0L -> N0 | b -> Npos (positive b)

(* The same as one of Coq's unary numbers, which must be small. *)
let small_number word =
  let b = bits word in
  if b < 0L || b > 100_000L then malformed "too large here: '%s'" word;
  let rec nat k = if k = 0 then O else S (nat (k - 1)) in
  nat (Int64.to_int b)
let rec of_nat = function O -> 0 | S k -> 1 + of_nat k

let show n =
  let rec to_bits width = function
    | _ when width = 0 -> failwith "a number of more than 64 bits"
    | XH -> 1L
    | XO p -> Int64.shift_left (to_bits (width - 1) p) 1
    | XI p -> Int64.logor 1L (Int64.shift_left (to_bits (width - 1) p) 1)
  in
  match n with N0 -> "0" | Npos p -> Printf.sprintf "%Lu" (to_bits 64 p)

let read_limits maximum block window genesis =
  let l = { maximum = number maximum; block = number block; window = number window;
            genesis_count = number genesis } in
  if not (N.ltb l.genesis_count l.maximum) then malformed "no room above the genesis marks";
  l

(* Lines, each with whether it has its end, which the last one may lack. *)
let rec lines_of channel () =
  let start = pos_in channel in
  match input_line channel with
  | exception End_of_file -> Seq.Nil
  | line -> Seq.Cons ((line, pos_in channel > start + String.length line), lines_of channel)

let lines_of_text text =
  let rec lines = function
    | [] | [ "" ] -> []
    | [ cut ] -> [ (cut, false) ]
    | line :: rest -> (line, true) :: lines rest
  in
  List.to_seq (lines (String.split_on_char '\n' text))

(* Calls [obey] with each line's words, which one space parts; [at] is the line's number. *)
let for_each_line at lines obey =
  let each (line, ended) =
    incr at;
    if not ended then malformed "cut short: the line has no end";
    obey (String.split_on_char ' ' line)
  in
  Seq.iter each lines
