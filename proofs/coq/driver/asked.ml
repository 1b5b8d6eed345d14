(* SPDX-License-Identifier: Apache-2.0 *)
(* What a proof claims, what is asked of it, and which of two claims is the stronger one: proofs/FORMAT.md, section 6.
   Nothing here reads a file, or knows how a claim is proved. *)
open Blocks

(* same has for each vertex the one that stands for it; cells are those before merging. Those from listed on are the
   vertices without a cell. *)
type claim = { source : int; points : bool; strict : bool; ring : int; eta : float; excluded : (int * int) list;
               same : int array; cells : int array array; listed : int; hash : string;
               motion : Trajectory.trajectory }

let motions = [| "linear"; "rest"; "run" |]
let pairs_text pairs = String.concat "," (List.rev (List.rev_map (fun (a, b) -> Printf.sprintf "%d-%d" a b) pairs))
let number_text x = Printf.sprintf "%.17g" (x +. 0.0)
let hex hash =
  let digits c = Printf.sprintf "%02x" (Char.code c) in
  String.concat "" (List.map digits (List.of_seq (String.to_seq hash)))
let merged claim = let n = ref 0 in Array.iteri (fun v s -> if v <> s then incr n) claim.same; !n

(* Whether two cells count that have vertices u and v, not equal, one in each; or, if strict, one cell with both. *)
let compares_any claim strict =
  let excluded = Hashtbl.create 64 in List.iter (fun pair -> Hashtbl.replace excluded pair ()) claim.excluded;
  let counts a b = not (Hashtbl.mem excluded (min a b, max a b)) in
  (* By label: how many cells, and one or two of their vertices. *)
  let known = Hashtbl.create 64 in
  let add i cell =
    let label = claim.motion.labels.(i) in
    let cells, vertices = Option.value (Hashtbl.find_opt known label) ~default:(0, []) in
    let more all v =
      let v = claim.same.(v) in if List.mem v all || List.compare_length_with all 2 >= 0 then all else v :: all in
    Hashtbl.replace known label (cells + 1, Array.fold_left more vertices cell) in
  Array.iteri add claim.cells;
  let of_one i cell =
    let label = claim.motion.labels.(i) in
    counts label label && Array.exists (fun v -> claim.same.(v) <> claim.same.(cell.(0))) cell in
  let both (a, (cells, u)) (b, (_, v)) =
    counts a b && (a <> b || cells > 1) && List.exists (fun x -> List.exists (( <> ) x) (u @ v)) (u @ v) in
  let labels = List.of_seq (Hashtbl.to_seq known) in
  (strict && List.exists Fun.id (List.mapi of_one (Array.to_list claim.cells)))
  || List.exists (fun a -> List.exists (both a) labels) labels

(* What a witness shows; its step is counted from 0. *)
type shown = { step : int; one_cell : bool; of_points : bool; near : bool; labels : int * int; flat : bool }

(* On what it rests that is not asked by default. *)
let rests_on claim shown =
  let when_ holds text = if holds then text else "" in
  when_ shown.near (Printf.sprintf "; least distance %s, ring %d" (number_text claim.eta) claim.ring)
  ^ when_ shown.one_cell "; features of one cell count"
  ^ when_ shown.of_points "; vertices without a cell count"
  ^ when_ (claim.motion.dimension = 2 && not shown.flat) "; z does not count"

(* Fields that are not asked by name are None, or what is least. A part of the steps is asked as A..B or A..: from_step
   is A, and steps the last one. *)
type asked = { by_source : int option; by_dimension : int option; steps : int option; from_step : int; is_part : bool;
               is_strict : bool; with_points : bool; least : float; from_ring : int; may_merge : int;
               may_exclude : (int * int) list option; of_cells : string option; may_be_empty : bool }

let nothing = { by_source = None; by_dimension = None; steps = None; from_step = 1; is_part = false; is_strict = false;
                with_points = false; least = 0.0; from_ring = 1; may_merge = 0; may_exclude = None; of_cells = None;
                may_be_empty = false }

let source_of asked claim = Option.value asked.by_source ~default:(if claim.source = 2 then 2 else 0)
let dimension_of asked claim =
  Option.value asked.by_dimension ~default:(if claim.source = 2 then claim.motion.dimension else 3)

let require holds who field ?would_do says wanted =
  let would_do = Option.value would_do ~default:(field ^ "=" ^ says) in
  let named value = if value = "" then "nothing" else value in
  if not holds then
    raise (Rejected (Printf.sprintf "the claim: %s: %s says %s, asked was %s; --require %s asks for that" field who
                       (named says) (named wanted) would_do))

let require_cells who asked claim =
  let wanted = Option.value asked.of_cells ~default:claim.hash in
  require (wanted = claim.hash) who "cells" (hex claim.hash) (hex wanted)

(* How many steps, or from which to which. *)
let steps_text asked last = (if asked.is_part then string_of_int asked.from_step ^ ".." else "") ^ string_of_int last

(* Whether the step with this number, from 0, is looked at. Frame k ends step k - 1. *)
let counts asked claim number =
  let ends = if claim.source = 1 && source_of asked claim = 0 then 1 else 0 in
  not asked.is_part
  || (asked.from_step <= number + 1 && Option.fold ~none:true ~some:(fun n -> number < n + ends) asked.steps)

(* A last step is asked by name, and a claim up to this step, counted from 1, reaches it. 0: no step. *)
let enough_steps asked claim steps =
  let ends = if claim.source = 0 && source_of asked claim = 1 then 1 else 0 in
  match asked.steps with Some n -> steps > 0 && steps + ends >= n | None -> false

(* Rejects a claim that is weaker; flat: each of its steps is. *)
let require_claimed asked claim flat =
  let the_proof = require in
  let require holds field says wanted = the_proof holds "the proof" field says wanted in
  let source = source_of asked claim and dimension = dimension_of asked claim and merged = merged claim in
  let has = claim.motion.dimension in
  require (claim.source = source || (claim.source = 0 && source = 1)) "motion" motions.(claim.source) motions.(source);
  require (has = dimension || flat || (has = 2 && merged = 0)) "dimension" (string_of_int has)
    (string_of_int dimension);
  require (claim.strict || not asked.is_strict) "strict" "0" "1";
  require (claim.points || not asked.with_points) "points" "0" "1";
  require (claim.eta >= asked.least) "distance" (number_text claim.eta) (number_text asked.least);
  require (claim.ring <= asked.from_ring || asked.least = 0.0) "ring" (string_of_int claim.ring)
    (string_of_int asked.from_ring);
  let would_do = Printf.sprintf "merged=%d --require cells=%s" merged (hex claim.hash) in
  the_proof (merged <= asked.may_merge) "the proof" "merged" ~would_do (string_of_int merged)
    (string_of_int asked.may_merge);
  require_cells "the proof" asked claim;
  let may = Option.value asked.may_exclude ~default:(if claim.source = 2 then claim.excluded else []) in
  let known = Hashtbl.create 64 in List.iter (fun pair -> Hashtbl.replace known pair ()) may;
  let would_do = Printf.sprintf "excluded=%s --require cells=%s" (pairs_text claim.excluded) (hex claim.hash) in
  the_proof (List.for_all (Hashtbl.mem known) claim.excluded) "the proof" "excluded" ~would_do
    (pairs_text claim.excluded) (pairs_text may);
  let would_do = if claim.strict && compares_any claim true then "strict=1" else "empty=1" in
  the_proof (asked.may_be_empty || compares_any claim asked.is_strict) "the proof" "empty" ~would_do "1" "0"

(* Rejects a claim of too few steps; more: the trajectory goes on. *)
let require_steps asked claim steps more =
  let wanted = match asked.steps with
    | Some n -> steps_text asked n | None -> "all of them, and the trajectory goes on" in
  require (if asked.steps = None then not more else enough_steps asked claim steps) "the proof" "steps"
    (steps_text asked steps) wanted

(* Rejects a witness that refutes only more than what is asked. *)
let require_refuted asked claim shown =
  let who = Printf.sprintf "the witness in step %d" (shown.step + 1) in
  let require holds field says wanted = require holds who field says wanted and number = string_of_int in
  let source = source_of asked claim and dimension = dimension_of asked claim and merged = merged claim in
  let has = claim.motion.dimension in
  require (claim.source = source || (claim.source = 1 && source = 0)) "motion" motions.(claim.source) motions.(source);
  (* Frame k is in steps k - 1 and k. *)
  let step = shown.step + (if claim.source = source then 1 else 0) in
  require (Option.fold ~none:true ~some:(fun n -> step <= n) asked.steps) "steps" (number step)
    (steps_text asked (Option.value asked.steps ~default:0));
  require (has >= dimension || shown.flat) "dimension" (number has) (number dimension);
  require (not shown.one_cell || asked.is_strict) "strict" "1" "0";
  require (not shown.of_points || asked.with_points) "points" "1" "0";
  require (not shown.near || claim.eta <= asked.least) "distance" (number_text claim.eta) (number_text asked.least);
  require (not shown.near || claim.ring >= asked.from_ring) "ring" (number claim.ring) (number asked.from_ring);
  require (merged >= asked.may_merge) "merged" (number merged) (number asked.may_merge);
  require_cells who asked claim;
  let may = Option.value asked.may_exclude ~default:[] in
  require (not (List.mem shown.labels may)) "excluded" (pairs_text claim.excluded) (pairs_text may)

(* One more field, as it follows --require. *)
let with_field asked word =
  let check holds why = if not holds then raise (Rejected ("the command line, --require " ^ word ^ ": " ^ why)) in
  let at = Option.value (String.index_opt word '=') ~default:(String.length word) in
  let field = String.sub word 0 at and is_bare = at = String.length word in
  let value = if is_bare then "" else String.sub word (at + 1) (String.length word - at - 1) in
  (* Digits come first, so there is no sign. *)
  let read reader text =
    let impossible () = check false "expected a number that is possible there" in
    if text = "" || text.[0] < '0' || text.[0] > '9' then impossible ();
    try reader (cursor "" 0 "") text with Rejected _ -> impossible (); assert false in
  let number least most text =
    Z.to_int (read (fun c -> Frames.whole c (Z.of_int least) (Z.of_int (most + 1))) text) in
  let flag () = is_bare || number 0 1 value = 1 in
  let pair text = match String.split_on_char '-' text with
    | [a; b] -> (number 0 mask a, number 0 mask b)
    | _ -> check false "expected a number that is possible there"; assert false in
  match field with
  | "motion" ->
    let found = List.filter (fun i -> motions.(i) = value) [0; 1; 2] in
    check (found <> []) "expected linear, rest or run"; { asked with by_source = Some (List.hd found) }
  | "dimension" -> { asked with by_dimension = Some (number 2 3 value) }
  | "steps" ->
    (match String.split_on_char '.' value with
     | first :: "" :: (_ :: _ as last) ->
       let from_step = number 1 mask first and last = String.concat "." last in
       { asked with is_part = true; from_step; steps = if last = "" then None else Some (number from_step mask last) }
     | _ -> { asked with steps = Some (number 1 mask value) })
  | "strict" -> { asked with is_strict = flag () }
  | "points" -> { asked with with_points = flag () }
  | "empty" -> { asked with may_be_empty = flag () }
  | "distance" -> { asked with least = read (fun c -> Frames.decimal c false) value }
  | "ring" -> { asked with from_ring = number 1 mask value }
  | "merged" -> { asked with may_merge = number 0 mask value }
  | "excluded" ->
    check (not is_bare) "expected excluded=A-B,C-D, or excluded= for none";
    let all = if value = "" then [] else List.map pair (String.split_on_char ',' value) in
    let rec ascends = function
      | (a, b) :: rest -> a <= b && (match rest with next :: _ -> (a, b) < next | [] -> true) && ascends rest
      | [] -> true in
    let all = Option.value asked.may_exclude ~default:[] @ all in
    check (ascends all) "expected pairs A-B with A <= B, in ascending order"; { asked with may_exclude = Some all }
  | "cells" ->
    let is_digit c = (c >= '0' && c <= '9') || (c >= 'a' && c <= 'f') in
    check (String.length value = 64 && String.for_all is_digit value)
      "expected the hash of the cells: 64 digits 0-9, a-f";
    let byte i = Char.chr (int_of_string ("0x" ^ String.sub value (2 * i) 2)) in
    { asked with of_cells = Some (String.init 32 byte) }
  | _ ->
    check false
      "expected motion, dimension, steps, strict, points, distance, ring, merged, excluded, cells or empty";
    asked

let of_words words =
  let field word = List.hd (String.split_on_char '=' word) in
  let check holds word why = if not holds then raise (Rejected ("the command line, --require " ^ word ^ ": " ^ why)) in
  let one (asked, given) word =
    check (field word = "excluded" || not (List.mem (field word) given)) word "the field is asked twice";
    (with_field asked word, field word :: given) in
  let asked, _ = List.fold_left one (nothing, []) words in
  check (asked.of_cells <> None || Option.value asked.may_exclude ~default:[] = []) "excluded"
    "only the cells say what labels are: expected cells=HASH too";
  check (asked.of_cells <> None || asked.may_merge = 0) "merged"
    "only the cells say which are merged: expected cells=HASH too";
  check (asked.least > 0.0 || asked.from_ring = 1) "ring"
    "says who may be nearer than a distance: expected distance=ETA too";
  asked

(* What makes an accepted claim weaker than the one that is asked by default. first_steps: the trajectory goes on. *)
let weaker asked claim steps first_steps =
  let when_ holds text = if holds then text else "" and n = List.length claim.excluded and merged = merged claim in
  let pairs = if n > 8 then Printf.sprintf "%d pairs" n else pairs_text claim.excluded in
  when_ (claim.source = 1) "; frames at rest"
  ^ when_ (merged > 0) (Printf.sprintf "; %d merged vertices" merged)
  ^ when_ (claim.source < 2 && n > 0) ("; not compared: " ^ pairs)
  ^ when_ (not (compares_any claim claim.strict)) "; the claim is empty"
  ^ when_ asked.is_part ("; steps " ^ steps_text asked steps)
  ^ when_ (first_steps && not asked.is_part) (Printf.sprintf "; the first %d steps" steps)
