(* Reads lines `function argument...`; prints for each the result, or `undefined`. *)
open Interpreter

let rec positive n = if n = 1 then XH else if n land 1 = 1 then XI (positive (n / 2)) else XO (positive (n / 2))
let small n = if n = 0 then Z0 else if n > 0 then Zpos (positive n) else Zneg (positive (-n))
let ten = small 10

let number text =
  let negative = text.[0] = '-' in
  let digits = if negative then String.sub text 1 (String.length text - 1) else text in
  let n = String.fold_left (fun n c -> Z.add (Z.mul n ten) (small (Char.code c - 48))) Z0 digits in
  if negative then Z.opp n else n

let rec digit = function Z0 -> 0 | Zneg _ -> assert false
  | Zpos p -> let rec value = function XH -> 1 | XO p -> 2 * value p | XI p -> 2 * value p + 1 in value p

let rec text z = match z with
  | Zneg _ -> "-" ^ text (Z.opp z)
  | _ -> let rest = Z.quot z ten in
    (if rest = Z0 then "" else text rest) ^ string_of_int (digit (Z.rem z ten))

let rec nat n = if n = 0 then O else S (nat (n - 1))
let fuel = nat 1000

let answer line = match String.split_on_char ' ' line with
  | [] -> failwith "an empty line"
  | name :: arguments ->
    let values = List.map (fun a -> Int (number a)) arguments in
    let in_memory = String.length name > 7 && String.sub name 0 7 = "memory_" in
    let memory (_, index) = (* one block, with an array of two *)
      if in_memory && index = Z0 then Some (List.nth values 0)
      else if in_memory && index = Zpos XH then Some (List.nth values 1) else None in
    let told = match name, values with
      | "control_of", [low; high] -> [Struct ["low", low; "high", high]]
      | _ -> if in_memory then [Pointer (N0, Z0)] else values in
    match run kernel (fun _ _ m -> m) fuel name told { memory_of = memory; calls_of = [] } with
    | Some (Int z, _) -> text z
    | Some _ -> failwith (line ^ ": no number")
    | None -> "undefined"

let () = try while true do print_endline (answer (input_line stdin)) done with End_of_file -> ()
