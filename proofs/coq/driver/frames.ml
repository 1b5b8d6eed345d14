(* SPDX-License-Identifier: Apache-2.0 *)
(* Frames: PLY and OBJ, as proofs/FORMAT.md, section 8, says. *)
open Blocks

(* Cells are arrays of vertex ids, in the order of the file. *)
type mesh = { vertices : int; cells : int array array }

(* Without cells that are redundant when same v stands for v. Faces, edges and points are each in their order. *)
let irredundant vertices same (faces, edges, points) =
  let known = Hashtbl.create 1024 and used = Bytes.make (if points = [] then 0 else vertices) ' ' in
  let is_new a b =
    let edge = (min (same a) (same b), max (same a) (same b)) in
    not (Hashtbl.mem known edge) && (Hashtbl.add known edge (); true) in
  let all_edges f = for i = 0 to 2 do ignore (is_new f.(i) f.((i + 1) mod 3)) done in
  if edges <> [] then List.iter all_edges faces;
  let cells = List.rev_append (List.rev faces) (List.filter (fun e -> is_new e.(0) e.(1)) edges) in
  let use v = let before = Bytes.get used (same v) in Bytes.set used (same v) 'x'; before = ' ' in
  if points <> [] then List.iter (Array.iter (fun v -> ignore (use v))) cells;
  Array.of_list (List.rev_append (List.rev cells) (List.filter (fun p -> use p.(0)) points))

(* Cells while they are read, last first. *)
type raw = { mutable faces : int array list; mutable edges : int array list; mutable points : int array list }

let rec polygon raw = function
  | [a] -> raw.points <- [| a |] :: raw.points
  | [a; b] -> raw.edges <- [| a; b |] :: raw.edges
  | a :: b :: (c :: rest) ->
    raw.faces <- [| a; b; c |] :: raw.faces;
    if rest <> [] then polygon raw (a :: c :: rest)
  | [] -> ()

let mesh_of raw vertices =
  { vertices; cells = irredundant vertices Fun.id (List.rev raw.faces, List.rev raw.edges, List.rev raw.points) }

(* Lines of a text and their words. *)
type text = { data : string; path : string; mutable from : int; mutable number : int }

let wrong t why = reject (Printf.sprintf "%s, line %d" t.path t.number) why

let line t =
  let n = String.length t.data and first = t.from in
  let stop = Option.value (String.index_from_opt t.data first '\n') ~default:n in
  let cr = if stop > first && t.data.[stop - 1] = '\r' then 1 else 0 in
  t.from <- min n (stop + 1);
  t.number <- t.number + 1;
  if first = n then None else Some (String.sub t.data first (stop - first - cr))

let words s = List.filter (( <> ) "") (String.split_on_char ' ' (String.map (fun c -> if c = '\t' then ' ' else c) s))

(* Where the digits from a place on end. *)
let rec digits s i = if i < String.length s && s.[i] >= '0' && s.[i] <= '9' then digits s (i + 1) else i

(* A plus may be there, but not before a minus. *)
let unsigned s =
  let n = String.length s in
  if n > 1 && s.[0] = '+' && s.[1] <> '-' then String.sub s 1 (n - 1) else s

let whole t low high word =
  let s = unsigned word in
  let n = String.length s and sign = if Z.sign low < 0 && word.[0] = '-' then 1 else 0 in
  if n = sign || digits s sign < n then wrong t "expected an integer";
  let z = if n < 18 then Z.of_int (int_of_string s) else Z.of_string s in
  if Z.lt z low || Z.gt z high then wrong t "an integer is out of range" else z

(* A decimal number, rounded once. Where its double is the middle of two binary32, it is exactly compared with that. *)
let decimal t single word =
  let s = unsigned word in
  let n = String.length s in
  let is i chars = i < n && String.contains chars s.[i] in
  let first = if is 0 "-" then 1 else 0 in
  let a = digits s first in
  let b = if is a "." then digits s (a + 1) else a in
  let e = if is (b + 1) "+-" then b + 2 else b + 1 in
  let complete = if is b "eE" then digits s e > e && digits s e = n else b = n in
  if not complete || b - first <= (if b > a then 1 else 0) then wrong t "expected a number";
  let m = String.concat "" (String.split_on_char '.' (String.sub s first (b - first))) and x = float_of_string s in
  let over () =
    let exponent = if is b "eE" then int_of_string (String.sub s (b + 1) (n - b - 1)) else 0 in
    let n, e = split x and tens = exponent - max 0 (b - a - 1) in
    let power base k = Z.pow (Z.of_int base) (max 0 k) in
    let left = Z.mul (Z.of_string m) (Z.mul (power 10 tens) (power 2 (-e))) in
    Z.compare left (Z.mul (Z.of_int n) (Z.mul (power 10 (-tens)) (power 2 e))) in
  let bits = Int64.bits_of_float x in
  let beside = if single && x <> 0.0 && is_finite x && Int64.to_int bits land 0xfffffff = 0 then over () else 0 in
  let x = Int64.float_of_bits (Int64.add bits (Int64.of_int beside)) in
  let x = if single then Int32.float_of_bits (Int32.bits_of_float x) else x in
  if not (is_finite x) || (x = 0.0 && not (String.for_all (( = ) '0') m)) then wrong t "a number is out of range" else x

(* OBJ *)

let skipped = ["vt"; "vn"; "vp"; "g"; "o"; "s"; "mg"; "usemtl"; "mtllib"; "usemap"; "maplib"; "lod"; "bevel";
               "c_interp"; "d_interp"; "shadow_obj"; "trace_obj"]

let two n = Z.shift_left Z.one n

(* v, v/vt, v//vn, v/vt/vn: what follows the first slash is not used. *)
let corner t known word =
  let v = whole t (Z.neg (two 63)) (Z.pred (two 63)) (List.hd (String.split_on_char '/' word)) in
  if Z.sign v = 0 || Z.lt v (Z.of_int (-known)) || Z.gt v (Z.of_int mask) then wrong t "an index is 0 or out of range";
  if Z.sign v > 0 then Z.to_int v - 1 else known + Z.to_int v

let read_obj t =
  let x = Buffer.create 65536 and raw = { faces = []; edges = []; points = [] } in
  let known () = Buffer.length x / 24 in
  let rec statement before =
    match line t with
    | None -> if before = [] then None else Some (String.concat " " (List.rev before))
    | Some l when l <> "" && l.[String.length l - 1] = '\\' && not (String.contains l '#') ->
      statement (String.sub l 0 (String.length l - 1) :: before)
    | Some l -> Some (String.concat " " (List.rev (l :: before))) in
  let vertex numbers =
    let n = List.length numbers in
    if n < 2 || n = 5 || n > 7 || known () = mask then wrong t "one vertex too many, or not 2, 3, 4, 6, 7 numbers";
    let put i v = if i < 3 then Buffer.add_int64_le x (Int64.bits_of_float v) in
    List.iteri put (List.map (decimal t false) numbers @ [0.0]) in
  let take = function
    | [] -> ()
    | "v" :: r -> vertex r
    | ("f" | "l" | "p" as kind) :: r ->
      let least = match kind with "f" -> 3 | "l" -> 2 | _ -> 1 in
      let corners = List.rev (List.rev_map (corner t (known ())) r) in
      if List.compare_length_with corners least < 0 then wrong t "too few vertices";
      if kind = "f" then polygon raw corners;
      if kind = "p" then List.iter (fun v -> polygon raw [v]) corners;
      if kind = "l" then ignore (List.fold_left (fun a b -> polygon raw [a; b]; b) (List.hd corners) (List.tl corners))
    | w :: _ -> if not (List.mem w skipped) then wrong t "expected a statement of a mesh" in
  let rec read () =
    let comment = ref false in
    let is_code w = comment := !comment || w.[0] = '#'; not !comment in
    match statement [] with None -> () | Some s -> take (List.filter is_code (words s)); read () in
  read ();
  let n = known () and x = Buffer.contents x in
  let there v = if v >= n then wrong t "a vertex that is not there is named" in
  List.iter (List.iter (Array.iter there)) [raw.faces; raw.edges; raw.points];
  (mesh_of raw n, Array.init (3 * n) (fun i -> Int64.float_of_bits (String.get_int64_le x (8 * i))))

(* PLY. Types: b h i q for integers of 1 2 4 8 bytes, upper case for unsigned ones, f d for real ones. *)

type use = Nothing | Axis of int | Corner | First | Second
type property = { kind : char; length : char option; label : string; use : use }
type element = { title : string; count : int; properties : property list }

let types = ["char"; "uchar"; "short"; "ushort"; "int"; "uint"; "float"; "double"; "int8"; "uint8"; "int16"; "uint16";
             "int32"; "uint32"; "int64"; "uint64"; "float32"; "float64"]

let code t name =
  match List.find_opt (fun (n, _) -> n = name) (List.mapi (fun i n -> (n, "bBhHiIfdbBhHiIqQfd".[i])) types) with
  | Some (_, c) -> c
  | None -> wrong t "expected the name of a type"

let size = function 'b' | 'B' -> 1 | 'h' | 'H' -> 2 | 'd' | 'q' | 'Q' -> 8 | _ -> 4
let is_real kind = kind = 'f' || kind = 'd'

let property t title length kind label =
  let length = Option.map (code t) length and kind = code t kind in
  let use = match title, label with
    | "vertex", "x" -> Axis 0 | "vertex", "y" -> Axis 1 | "vertex", "z" -> Axis 2
    | "face", ("vertex_indices" | "vertex_index") -> Corner | "edge", "vertex1" -> First | "edge", "vertex2" -> Second
    | _ -> Nothing in
  if use <> Nothing && (length <> None) <> (use = Corner) then wrong t "a property is a list, or is none";
  if Option.fold ~none:false ~some:is_real length || (is_real kind && List.mem use [Corner; First; Second]) then
    wrong t "expected an integer type";
  { kind; length; label; use }

let complete t e =
  let uses = List.filter (( <> ) Nothing) (List.map (fun p -> p.use) e.properties) in
  let of_vertex = if List.mem (Axis 2) uses then 3 else 2 in
  let wanted = match e.title with "vertex" -> of_vertex | "face" -> 1 | "edge" -> 2 | _ -> 0 in
  if e.count > 0 && (e.properties = [] || e.title = "tristrips" || List.length uses <> wanted) then
    wrong t ("element " ^ e.title ^ " is not read, or has not just the properties that it needs");
  { e with properties = List.rev e.properties }

let rec header t format elements =
  match Option.map (fun l -> (l, words l)) (line t), elements with
  | Some ("end_header", _), _ when format <> "" -> (format, List.rev_map (complete t) elements)
  | Some (_, ("comment" | "obj_info") :: _), _ -> header t format elements
  | Some (_, ["format"; ("ascii" | "binary_little_endian" | "binary_big_endian" as f); "1.0"]), _ when format = "" ->
    header t f elements
  | Some (_, ["element"; title; count]), _ when List.for_all (fun e -> e.title <> title) elements ->
    header t format ({ title; count = Z.to_int (whole t Z.zero (Z.pred (two 62)) count); properties = [] } :: elements)
  | Some (_, "property" :: w), e :: before ->
    let p = match w with
      | ["list"; length; kind; label] -> property t e.title (Some length) kind label
      | [kind; label] when kind <> "list" -> property t e.title None kind label
      | _ -> wrong t "expected a property" in
    if List.exists (fun o -> o.label = p.label) e.properties then wrong t "a property is there twice";
    header t format ({ e with properties = p :: e.properties } :: before)
  | _ -> wrong t "expected a line of a header"

let read_ply t =
  if line t <> Some "ply" then wrong t "expected ply";
  let format, elements = header t "" [] in
  let ascii = format = "ascii" and big = format = "binary_big_endian" and rest = ref [] in
  let c = { bytes = t.data; at = t.from; file = t.path; offset = 0 } in
  let raw = { faces = []; edges = []; points = [] } and x = ref [||] in
  let vertices = match List.find_opt (fun e -> e.title = "vertex") elements with Some e -> e.count | None -> -1 in
  if vertices < 0 || vertices > mask then wrong t "expected an element vertex, of below 2^32 vertices";
  let word () = match !rest with w :: r -> rest := r; w | [] -> wrong t "the line ends within an entry" in
  let bits n =
    let at = skip c n in
    let rec from i high =
      let byte = if big then at + i else at + n - 1 - i in
      if i = n then high else from (i + 1) (Z.add (Z.shift_left high 8) (Z.of_int (Char.code c.bytes.[byte]))) in
    from 0 Z.zero in
  let integer kind =
    let n = 8 * size kind and is_signed = Char.lowercase_ascii kind = kind in
    let low, above = if is_signed then (Z.neg (two (n - 1)), two (n - 1)) else (Z.zero, two n) in
    if ascii then whole t low (Z.pred above) (word ())
    else if is_signed then Z.signed_extract (bits (n / 8)) 0 n else bits (n / 8) in
  let real kind =
    let v =
      if not (is_real kind) then
        let n = integer kind in
        let v = Z.to_float n in
        if Z.equal (Z.of_float v) n then v else wrong t "an integer is no double"
      else if ascii then decimal t (kind = 'f') (word ())
      else if kind = 'f' then Int32.float_of_bits (Z.to_int32 (Z.signed_extract (bits 4) 0 32))
      else Int64.float_of_bits ((if big then String.get_int64_be else String.get_int64_le) c.bytes (skip c 8)) in
    if is_finite v then v else wrong t "expected a finite number" in
  let vertex kind =
    let v = integer kind in
    if Z.sign v < 0 || Z.geq v (Z.of_int vertices) then wrong t "a vertex that is not there is named" else Z.to_int v in
  let value i corners p =
    match p.use with
    | Nothing -> if ascii then ignore (word ()) else ignore (skip c (size p.kind)); corners
    | Axis k -> !x.((3 * i) + k) <- real p.kind; corners
    | First -> corners @ [vertex p.kind]
    | Corner | Second -> vertex p.kind :: corners in
  let property i corners p =
    let n = match p.length with None -> Z.one | Some k -> integer k in
    if Z.sign n < 0 || Z.gt n (Z.of_int (String.length t.data)) then wrong t "a list has an impossible length";
    let rec values corners n = if n = 0 then corners else values (value i corners p) (n - 1) in
    values corners (Z.to_int n) in
  let rec next_line is_last =
    match line t with
    | None -> if not is_last then wrong t "the file ends within an element"
    | Some l ->
      rest := words l;
      if !rest = [] then next_line is_last else if is_last then wrong t "expected the end of the file" in
  let entry e i =
    if ascii then next_line false;
    let corners = List.fold_left (property i) [] e.properties in
    if !rest <> [] then wrong t "expected the end of the line";
    if e.title = "face" && corners = [] then wrong t "a face without vertices";
    polygon raw (List.rev corners) in
  let read e =
    let least p = size (Option.value p.length ~default:p.kind) in
    let entry_size = if ascii then 2 else max 1 (List.fold_left (fun n p -> n + least p) 0 e.properties) in
    if e.count > (String.length t.data + 1 - if ascii then t.from else c.at) / entry_size then
      wrong t ("the file is too short for its element " ^ e.title);
    if e.title = "vertex" then x := Array.make (3 * e.count) 0.0;
    for i = 0 to e.count - 1 do entry e i done in
  List.iter read elements;
  if ascii then next_line true else finish c;
  (mesh_of raw vertices, !x)

(* The mesh and the positions, three coordinates a vertex. *)
let read_frame path =
  let channel = open_in_bin path and all = Buffer.create 65536 and part = Bytes.create 65536 in
  let rec read () =
    let n = input channel part 0 65536 in
    if n > 0 then (Buffer.add_subbytes all part 0 n; read ()) in
  read ();
  close_in channel;
  let t = { data = Buffer.contents all; path; from = 0; number = 0 } and n = String.length path in
  match String.lowercase_ascii (String.sub path (max 0 (n - 4)) (min n 4)) with
  | ".ply" -> read_ply t
  | ".obj" when t.data <> "" -> read_obj t
  | _ -> wrong t "is empty, or its name does not end in .ply or .obj"
