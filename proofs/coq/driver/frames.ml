(* SPDX-License-Identifier: Apache-2.0 *)
(* Frames: PLY and OBJ, as proofs/FORMAT.md, section 9, says. *)
open Blocks

(* Cells are arrays of vertex ids: faces, edges, points, each in the order of the file. *)
type mesh = { vertices : int; cells : int array array }

(* Without cells that are redundant when same v stands for v: edges and points that are there already. *)
let irredundant same cells =
  let known = Hashtbl.create 64 in
  let is_new part =
    let key = List.sort compare (List.map same part) in
    not (Hashtbl.mem known key) && (Hashtbl.add known key (); true) in
  let keep cell =
    let edges = match cell with [| a; b; c |] -> [[a; b]; [b; c]; [c; a]] | _ -> [] and all = Array.to_list cell in
    let kept = edges <> [] || is_new all in
    List.iter (fun part -> ignore (is_new part)) (edges @ List.map (fun v -> [v]) all); kept in
  if Array.for_all (fun cell -> Array.length cell = 3) cells then cells
  else Array.of_list (List.filter keep (Array.to_list cells))

(* Cells in the order of the file, last first, with those of a polygon. *)
let rec polygon cells = function
  | a :: b :: c :: (_ :: _ as rest) -> polygon ([| a; b; c |] :: cells) (a :: c :: rest)
  | [] -> cells
  | corners -> Array.of_list corners :: cells

let mesh_of vertices cells =
  let only n = Array.of_list (List.rev (List.filter (fun cell -> Array.length cell = n) cells)) in
  { vertices; cells = irredundant Fun.id (Array.concat [only 3; only 2; only 1]) }

(* Words are separated by blanks and tabs; a line ends with LF, CRLF, or the text. *)
let at c i = if c.at + i < String.length c.bytes then c.bytes.[c.at + i] else '\n'
let at_end c = at c 0 = '\n' || (at c 0 = '\r' && at c 1 = '\n')
let at_blank c = at c 0 = ' ' || at c 0 = '\t'
let skip_blanks c = while at_blank c do c.at <- c.at + 1 done

(* The next word of the line, "" if there is none. *)
let word c =
  skip_blanks c;
  let first = c.at in
  while not (at_end c || at_blank c) do c.at <- c.at + 1 done;
  String.sub c.bytes first (c.at - first)

let end_line c =
  check c (word c = "") "expected the end of the line";
  c.at <- min (String.length c.bytes) (c.at + if at c 0 = '\r' then 2 else 1)

let rec skip_blank_lines c = skip_blanks c; if at_end c && left c > 0 then (end_line c; skip_blank_lines c)

(* A line, and its words. *)
let line c =
  let rec words before = match word c with "" -> List.rev before | w -> words (w :: before) in
  let first = c.at in let all = words [] in
  let text = String.sub c.bytes first (c.at - first) in end_line c;
  (text, all)

(* Where the digits from a place on end. A plus may be before a number, but not before a minus. *)
let rec digits s i = if i < String.length s && s.[i] >= '0' && s.[i] <= '9' then digits s (i + 1) else i
let unsigned s = if String.length s > 1 && s.[0] = '+' && s.[1] <> '-' then String.sub s 1 (String.length s - 1) else s

(* An integer from low to before high. *)
let within c low high z = check c (Z.leq low z && Z.lt z high) "an integer is out of range"; z
let whole c low high word =
  let s = unsigned word in
  let n = String.length s and sign = if Z.sign low < 0 && s <> "" && s.[0] = '-' then 1 else 0 in
  check c (n > sign && digits s sign = n) "expected an integer";
  within c low high (if n < 18 then Z.of_int (int_of_string s) else Z.of_string_base 10 s)

(* A decimal number, rounded once: where its double is in the middle of two binary32, it goes to the number's side. *)
let decimal c single word =
  let s = unsigned word in let n = String.length s in
  let is i chars = i < n && String.contains chars s.[i] in let first = if is 0 "-" then 1 else 0 in
  let a = digits s first in let b = if is a "." then digits s (a + 1) else a in
  let e = if is (b + 1) "+-" then b + 2 else b + 1 in
  let complete = if is b "eE" then digits s e > e && digits s e = n else b = n in
  check c (complete && b - first > (if b > a then 1 else 0)) "expected a number";
  let x = finite c (float_of_string s) in let bits = Int64.bits_of_float x in
  let is_middle = single && x <> 0.0 && Int64.to_int bits land 0xfffffff = 0 in
  let side = if is_middle then Q.compare (Q.abs (Q.of_string s)) (Q.abs (Q.of_float x)) else 0 in
  let nearest x = if single then Int32.float_of_bits (Int32.bits_of_float x) else x in
  let x = finite c (nearest (Int64.float_of_bits (Int64.add bits (Int64.of_int side)))) in
  check c (x <> 0.0 || String.for_all (fun d -> d < '1' || d > '9') (String.sub s 0 b)) "a number is out of range";
  x

let two n = Z.shift_left Z.one n

let skipped = ["vt"; "vn"; "vp"; "g"; "o"; "s"; "mg"; "usemtl"; "mtllib"; "usemap"; "maplib"; "lod"; "bevel";
               "c_interp"; "d_interp"; "shadow_obj"; "trace_obj"]

let read_obj c =
  let places = ref [] and known = ref 0 and cells = ref [] and flat = ref false in
  let cell corners = cells := polygon !cells corners in
  (* A line that ends with a backslash goes on in the next. *)
  let rec statement earlier =
    let text, words = line c in let n = String.length text in
    if n = 0 || text.[n - 1] <> '\\' || String.contains text '#' then List.rev_append earlier words
    else
      let _, before = line (cursor c.file 0 (String.sub text 0 (n - 1))) in
      statement (List.rev_append before earlier) in
  let vertex numbers =
    let n = List.length numbers in
    check c (n >= 2 && n <> 5 && n <= 7 && !known < mask) "one vertex too many, or not 2, 3, 4, 6, 7 numbers";
    if !known = 0 then flat := n = 2;
    check c ((n = 2) = !flat) "some vertices have 2 coordinates, and others have 3";
    places := Array.sub (Array.of_list (List.map (decimal c false) numbers @ [0.0])) 0 3 :: !places;
    incr known in
  (* v, v/vt, v//vn, v/vt/vn: what follows the first slash is not used. *)
  let corner word =
    let v = whole c (Z.of_int (- !known)) (two 32) (List.hd (String.split_on_char '/' word)) in
    check c (Z.sign v <> 0) "an index is 0"; if Z.sign v > 0 then Z.to_int v - 1 else !known + Z.to_int v in
  let corners least words =
    check c (List.compare_length_with words least >= 0) "too few vertices";
    List.rev (List.rev_map corner words) in
  while left c > 0 do
    let comment = ref false in let is_code w = comment := !comment || w.[0] = '#'; not !comment in
    match List.filter is_code (statement []) with
    | "v" :: numbers -> vertex numbers | "f" :: r -> cell (corners 3 r)
    | "p" :: r -> List.iter (fun v -> cell [v]) (corners 1 r)
    | "l" :: r -> ignore (List.fold_left (fun a b -> if a >= 0 then cell [a; b]; b) (-1) (corners 2 r))
    | other -> check c (other = [] || List.mem (List.hd other) skipped) "expected a statement of a mesh"
  done;
  check c (List.for_all (Array.for_all (fun v -> v < !known)) !cells) "a vertex that is not there is named";
  (mesh_of !known !cells, Array.of_list (List.rev !places))

(* PLY. Types by name: how many bytes, and whether there are negative numbers, or fractions. *)
type kind = Signed | Unsigned | Real
let kinds = ["char", (1, Signed); "short", (2, Signed); "int", (4, Signed); "float", (4, Real); "double", (8, Real);
             "uchar", (1, Unsigned); "ushort", (2, Unsigned); "uint", (4, Unsigned); "int8", (1, Signed);
             "int16", (2, Signed); "int32", (4, Signed); "int64", (8, Signed); "uint8", (1, Unsigned);
             "uint16", (2, Unsigned); "uint32", (4, Unsigned); "uint64", (8, Unsigned); "float32", (4, Real);
             "float64", (8, Real)]

(* What is used, and its place: an axis, or the corners of a cell. *)
let places = ["vertex x", 0; "vertex y", 1; "vertex z", 2; "face vertex_indices", 0; "face vertex_index", 0;
              "edge vertex1", 0; "edge vertex2", 1]
type property = { kind : int * kind; length : (int * kind) option; label : string; place : int option }
type element = { title : string; count : int; properties : property list }

let property c title length kind label =
  let find name = match List.assoc_opt name kinds with Some k -> k | None -> fail c "expected the name of a type" in
  let length = Option.map find length and kind = find kind and place = List.assoc_opt (title ^ " " ^ label) places in
  check c (place = None || (length <> None) = (title = "face")) "a property is a list, or is none";
  let must_be_integer = Option.to_list length @ if place <> None && title <> "vertex" then [kind] else [] in
  check c (List.for_all (fun (_, k) -> k <> Real) must_be_integer) "expected an integer type";
  { kind; length; label; place }

(* The properties of an element are last first until it is complete. *)
let complete c e =
  let places = List.filter_map (fun p -> p.place) e.properties in
  let wanted = match e.title with "vertex" -> if List.mem 2 places then 3 else 2 | "face" -> 1 | "edge" -> 2 | _ -> 0 in
  check c (e.count = 0 || (e.properties <> [] && e.title <> "tristrips" && List.length places = wanted))
    ("element " ^ e.title ^ " is not read, or has not just the properties that it needs");
  { e with properties = List.rev e.properties }

let rec header c format elements =
  match line c, elements with
  | ("end_header", _), _ when format <> "" -> (format, List.rev_map (complete c) elements)
  | (_, ("comment" | "obj_info") :: _), _ -> header c format elements
  | (_, ["format"; ("ascii" | "binary_little_endian" | "binary_big_endian" as f); "1.0"]), _ when format = "" ->
    header c f elements
  | (_, ["element"; title; count]), _ when List.for_all (fun e -> e.title <> title) elements ->
    header c format ({ title; count = Z.to_int (whole c Z.zero (two 62) count); properties = [] } :: elements)
  | (_, "property" :: w), e :: before ->
    let p = match w with
      | ["list"; length; kind; label] -> property c e.title (Some length) kind label
      | [kind; label] when kind <> "list" -> property c e.title None kind label
      | _ -> fail c "expected a property" in
    check c (List.for_all (fun o -> o.label <> p.label) e.properties) "a property is there twice";
    header c format ({ e with properties = p :: e.properties } :: before)
  | _ -> fail c "expected a line of a header"

let read_ply c =
  check c (fst (line c) = "ply") "expected ply";
  let format, elements = header c "" [] in
  let ascii = format = "ascii" and x = ref [||] and cells = ref [] in
  let vertices = match List.find_opt (fun e -> e.title = "vertex") elements with Some e -> e.count | None -> -1 in
  check c (vertices >= 0 && vertices <= mask) "expected an element vertex, of below 2^32 vertices";
  (* The next number: a word, or bytes, the lowest first. *)
  let next (size, _) =
    let s = if ascii then word c else take c size in check c (s <> "") "the line ends within an entry";
    if format = "binary_big_endian" then reversed s else s in
  let integer ((size, sign) as kind) =
    let s = next kind and low, high = if sign = Signed then (8 * size) - 1, (8 * size) - 1 else -1, 8 * size in
    if ascii then whole c (if low < 0 then Z.zero else Z.neg (two low)) (two high) s
    else if low < 0 then Z.of_bits s else Z.signed_extract (Z.of_bits s) 0 (low + 1) in
  let real = function
    | (size, Real) as kind when ascii -> decimal c (size = 4) (next kind)
    | (8, Real) as kind -> f64 (cursor c.file c.at (next kind))
    | (_, Real) as kind -> finite c (Int32.float_of_bits (String.get_int32_le (next kind) 0))
    | kind ->
      let n = integer kind in check c (Z.equal (Z.of_float (Z.to_float n)) n) "an integer is no double";
      Z.to_float n in
  let entry e i =
    if ascii then skip_blank_lines c;
    let corners = ref [] in
    let value p = match p.place with
      | None -> ignore (next p.kind)
      | Some k when e.title = "vertex" -> !x.(i).(k) <- real p.kind
      | Some k ->
        let v = Z.to_int (within c Z.zero (Z.of_int vertices) (integer p.kind)) in
        corners := if k = 0 && e.title = "edge" then !corners @ [v] else v :: !corners in
    let values p =
      let n = Option.fold ~none:Z.one ~some:integer p.length in
      for _ = 1 to Z.to_int (within c Z.zero (Z.of_int (String.length c.bytes)) n) do value p done in
    List.iter values e.properties; if ascii then end_line c;
    check c (e.title <> "face" || !corners <> []) "a face without vertices";
    cells := polygon !cells (List.rev !corners) in
  let read e =
    let least p = fst (Option.value p.length ~default:p.kind) in
    need c e.count (if ascii then 1 else max 1 (List.fold_left (fun n p -> n + least p) 0 e.properties));
    if e.title = "vertex" then x := Array.init e.count (fun _ -> Array.make 3 0.0);
    for i = 0 to e.count - 1 do entry e i done in
  List.iter read elements; if ascii then skip_blank_lines c;
  finish c; (mesh_of vertices !cells, !x)

(* The last four letters of a name, and whether it is that of one frame. *)
let ending path =
  let n = String.length path in String.lowercase_ascii (String.sub path (max 0 (n - 4)) (min 4 n))
let is_frame path = List.mem (ending path) [".ply"; ".obj"]

(* The mesh and the positions, three coordinates a vertex. *)
let read_frame path =
  let channel = open_in_bin path in
  let c = cursor path 0 (really_input_string channel (in_channel_length channel)) in close_in channel;
  match ending path with
  | ".ply" -> read_ply c | ".obj" when c.bytes <> "" -> read_obj c
  | _ -> fail c "is empty, or its name does not end in .ply or .obj"
