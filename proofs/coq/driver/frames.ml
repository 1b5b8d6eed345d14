(* SPDX-License-Identifier: Apache-2.0 *)
(* Frames: PLY and OBJ, as proofs/FORMAT.md, section 8, says.
   Cells are lists of vertex ids, in arrays; x has three coordinates a vertex. *)
open Input

type mesh = { vertices : int; cells : int array array }
type frame = { mesh : mesh; x : float array }

(* Faces, edges and points as they are listed, without those that are redundant when same v stands for v. *)
let irredundant vertices same faces edges points =
  let known = Hashtbl.create 1024 and used = Bytes.make (if points = [] then 0 else vertices) '\000' in
  let add a b =
    let pair = (min (same a) (same b), max (same a) (same b)) in
    let is_new = not (Hashtbl.mem known pair) in
    if is_new then Hashtbl.add known pair ();
    is_new
  in
  let corner (f : int array) i = ignore (add f.(i) f.((i + 1) mod 3)) in
  if edges <> [] then List.iter (fun f -> corner f 0; corner f 1; corner f 2) faces;
  let cells = List.rev_append (List.rev faces) (List.filter (fun e -> add e.(0) e.(1)) edges) in
  let use v = Bytes.set used (same v) '\001' in
  if points <> [] then List.iter (Array.iter use) cells;
  let is_new p = let known = Bytes.get used (same p.(0)) <> '\000' in use p.(0); not known in
  Array.of_list (List.rev_append (List.rev cells) (List.filter is_new points))

(* Cells that are being read, last first. *)
type raw = { mutable faces : int array list; mutable edges : int array list; mutable points : int array list }

let polygon raw = function
  | [a] -> raw.points <- [| a |] :: raw.points
  | [a; b] -> raw.edges <- [| a; b |] :: raw.edges
  | a :: rest ->
    let triangle b c = raw.faces <- [| a; b; c |] :: raw.faces; c in
    ignore (List.fold_left triangle (List.hd rest) (List.tl rest))
  | [] -> ()

let frame raw vertices x =
  let cells = irredundant vertices Fun.id (List.rev raw.faces) (List.rev raw.edges) (List.rev raw.points) in
  { mesh = { vertices; cells }; x }

(* Lines of a text. *)
type text = { data : string; file : string; mutable from : int; mutable number : int }

let wrong t why = reject (Printf.sprintf "%s, line %d" t.file t.number) why

let line t =
  let n = String.length t.data in
  if t.from = n then None
  else begin
    let stop = match String.index_from_opt t.data t.from '\n' with Some i -> i | None -> n in
    let first = t.from and cr = stop > t.from && t.data.[stop - 1] = '\r' in
    t.from <- min n (stop + 1);
    t.number <- t.number + 1;
    Some (String.sub t.data first (stop - first - if cr then 1 else 0))
  end

let words s =
  let blank i = s.[i] = ' ' || s.[i] = '\t' in
  let rec from i acc =
    if i < 0 then acc
    else if blank i then from (i - 1) acc
    else begin
      let first = ref i in
      while !first > 0 && not (blank (!first - 1)) do decr first done;
      from (!first - 1) (String.sub s !first (i + 1 - !first) :: acc)
    end
  in
  from (String.length s - 1) []

let rec blank_lines t =
  match line t with Some l -> if words l = [] then blank_lines t else wrong t "expected the end of the file" | None -> ()

let is_digit c = c >= '0' && c <= '9'

(* Where the digits from a place on end. *)
let rec digits s i = if i < String.length s && is_digit s.[i] then digits s (i + 1) else i

(* A plus is allowed, but not before a minus. *)
let unsigned s =
  let n = String.length s in
  if n > 1 && s.[0] = '+' && s.[1] <> '-' then String.sub s 1 (n - 1) else s

let whole t low high word =
  let s = unsigned word in
  let n = String.length s and sign = if Z.sign low < 0 && s <> "" && s.[0] = '-' then 1 else 0 in
  if n = sign || digits s sign <> n then wrong t "expected an integer";
  let z = if n < 18 then Z.of_int (int_of_string s) else Z.of_string s in
  if Z.lt z low || Z.gt z high then wrong t "an integer is out of range" else z

(* The decimal number m 10^e, e written behind the m, compared with x: -1, 0, 1; x is not 0. *)
let compare_decimal s x =
  let upto = match String.index_opt (String.lowercase_ascii s) 'e' with Some i -> i | None -> String.length s in
  let mantissa = String.sub s 0 upto and from = upto + 1 in
  let e = if upto = String.length s then 0 else int_of_string (unsigned (String.sub s from (String.length s - from))) in
  let dot = match String.index_opt mantissa '.' with Some i -> i | None -> upto - 1 in
  let m = Z.of_string (String.concat "" (String.split_on_char '.' mantissa)) and e = e - (upto - 1 - dot) in
  let n, b = split x in
  let power k = Z.mul (Z.pow (Z.of_int 10) (max k 0)) in
  Z.compare (power e (Z.shift_left (Z.abs m) (max 0 (-b)))) (power (-e) (Z.shift_left (Z.of_int n) (max 0 b)))

(* To binary32, once: a decimal next to a middle of two of them that its double has hit goes to the side where it is. *)
let to_single s x =
  let bits = Int64.bits_of_float x in
  let aside = if Int64.to_int bits land 0xfffffff = 0 && x <> 0.0 then compare_decimal s x else 0 in
  Int32.float_of_bits (Int32.bits_of_float (Int64.float_of_bits (Int64.add bits (Int64.of_int aside))))

let decimal t single word =
  let s = unsigned word in
  let n = String.length s and at i = i < String.length s && s.[i] = '.' in
  let first = if n > 0 && s.[0] = '-' then 1 else 0 in
  let a = digits s first in
  let b = if at a then digits s (a + 1) else a in
  let stop =
    if b < n && (s.[b] = 'e' || s.[b] = 'E') then
      let e = if b + 1 < n && (s.[b + 1] = '-' || s.[b + 1] = '+') then b + 2 else b + 1 in
      if digits s e > e then digits s e else n + 1
    else b
  in
  if b - first < (if b > a then 2 else 1) || stop <> n then wrong t "expected a number";
  let x = float_of_string s in
  let x = if single && is_finite x then to_single s x else x in
  let rec all_0 i = i >= b || ((s.[i] = '0' || s.[i] = '.') && all_0 (i + 1)) in
  if not (is_finite x) || (x = 0.0 && not (all_0 first)) then wrong t "a number is out of range" else x

(* OBJ *)

let skipped =
  ["vt"; "vn"; "vp"; "g"; "o"; "s"; "mg"; "usemtl"; "mtllib"; "usemap"; "maplib"; "lod"; "bevel"; "c_interp";
   "d_interp"; "shadow_obj"; "trace_obj"]

let two_63 = Z.shift_left Z.one 63

(* v, v/vt, v//vn, v/vt/vn: at most so many parts. *)
let corner t known most word =
  let parts = String.split_on_char '/' word in
  if List.length parts > most then wrong t "an index has too many parts";
  let part i s =
    if i = 1 && s = "" && List.length parts > 2 then Z.one else whole t (Z.neg two_63) (Z.pred two_63) s in
  let indices = List.mapi part parts in
  let v = List.hd indices in
  if List.exists (Z.equal Z.zero) indices || Z.lt v (Z.of_int (-known)) || Z.gt v (Z.of_int mask) then
    wrong t "an index is 0 or out of range";
  if Z.sign v > 0 then Z.to_int v - 1 else known + Z.to_int v

let read_obj data file =
  let t = { data; file; from = 0; number = 0 } and x = Buffer.create 65536 in
  let raw = { faces = []; edges = []; points = [] } and known () = Buffer.length x / 24 in
  let rec statement before =
    match line t with
    | None -> if before = [] then None else Some (String.concat "" (List.rev before))
    | Some l ->
      let n = String.length l in
      if n > 0 && l.[n - 1] = '\\' && not (String.contains l '#') then statement ((String.sub l 0 (n - 1) ^ " ") :: before)
      else Some (String.concat "" (List.rev (l :: before)))
  in
  let code words =
    let comment = ref false in
    List.filter (fun w -> comment := !comment || w.[0] = '#'; not !comment) words in
  let corners least most words =
    if List.length words < least then wrong t "too few vertices";
    List.rev (List.rev_map (corner t (known ()) most) words) in
  let vertex words =
    let n = List.length words in
    if n < 2 || n = 5 || n > 7 then wrong t "a vertex has the wrong number of numbers";
    if known () = mask then wrong t "too many vertices";
    let numbers = List.map (decimal t false) words @ [0.0] in
    List.iteri (fun i v -> if i < 3 then Buffer.add_int64_le x (Int64.bits_of_float v)) numbers in
  let rec edges = function
    | a :: (b :: _ as r) -> raw.edges <- [| a; b |] :: raw.edges; edges r
    | _ -> () in
  let rec read () =
    match statement [] with
    | None -> ()
    | Some s ->
      (match code (words s) with
       | [] -> ()
       | "v" :: r -> vertex r
       | "f" :: r -> polygon raw (corners 3 3 r)
       | "l" :: r -> edges (corners 2 2 r)
       | "p" :: r -> List.iter (fun v -> raw.points <- [| v |] :: raw.points) (corners 1 1 r)
       | w :: _ -> if not (List.mem w skipped) then wrong t "expected a statement of a mesh");
      read ()
  in
  read ();
  let n = known () in
  let there c = if Array.exists (fun v -> v >= n) c then wrong t "a vertex that is not there is named" in
  List.iter (List.iter there) [raw.faces; raw.edges; raw.points];
  let x = Buffer.contents x in
  frame raw n (Array.init (3 * n) (fun i -> Int64.float_of_bits (String.get_int64_le x (8 * i))))

(* PLY *)

type kind = Signed | Unsigned | Real
type use = Nothing | Axis of int | Corners | First | Second
type property = { of_type : kind * int; length : (kind * int) option; label : string; use : use }
type element = { title : string; count : int; properties : property list }

let types =
  [("char", (Signed, 1)); ("uchar", (Unsigned, 1)); ("short", (Signed, 2)); ("ushort", (Unsigned, 2)); ("int", (Signed, 4));
   ("uint", (Unsigned, 4)); ("float", (Real, 4)); ("double", (Real, 8)); ("int8", (Signed, 1)); ("uint8", (Unsigned, 1));
   ("int16", (Signed, 2)); ("uint16", (Unsigned, 2)); ("int32", (Signed, 4)); ("uint32", (Unsigned, 4));
   ("int64", (Signed, 8)); ("uint64", (Unsigned, 8)); ("float32", (Real, 4)); ("float64", (Real, 8))]

let use_of title label =
  match title, label with
  | "vertex", "x" -> Axis 0 | "vertex", "y" -> Axis 1 | "vertex", "z" -> Axis 2
  | "face", ("vertex_indices" | "vertex_index") -> Corners
  | "edge", "vertex1" -> First | "edge", "vertex2" -> Second
  | _ -> Nothing

let property t title of_type length label =
  let find name = match List.assoc_opt name types with Some k -> k | None -> wrong t "expected the name of a type" in
  let p = { of_type = find of_type; length = Option.map find length; label; use = use_of title label } in
  (match p.length with Some (Real, _) -> wrong t "expected an integer type for a length" | _ -> ());
  if p.use <> Nothing && (p.length <> None) <> (p.use = Corners) then wrong t "a property is a list, or is none";
  if (p.use = Corners || p.use = First || p.use = Second) && fst p.of_type = Real then
    wrong t "expected an integer type for a vertex";
  p

(* Its properties come with the last first. *)
let complete t e =
  let uses = List.filter (fun u -> u <> Nothing) (List.map (fun p -> p.use) e.properties) in
  let wanted = match e.title with "vertex" -> if List.mem (Axis 2) uses then 3 else 2 | "face" -> 1 | "edge" -> 2 | _ -> 0 in
  if e.count > 0 && (e.properties = [] || e.title = "tristrips" || List.length uses <> wanted) then
    wrong t ("element " ^ e.title ^ " has not just the properties that it needs, or is not read");
  { e with properties = List.rev e.properties }

(* The format, and the elements in order. *)
let rec header t format elements =
  match line t with
  | None -> wrong t "expected end_header"
  | Some "end_header" -> if format = "" then wrong t "expected format" else (format, List.rev_map (complete t) elements)
  | Some l ->
    (match words l, elements with
     | ("comment" | "obj_info") :: _, _ -> header t format elements
     | ["format"; ("ascii" | "binary_little_endian" | "binary_big_endian" as f); "1.0"], _ when format = "" ->
       header t f elements
     | ["element"; title; count], _ when not (List.exists (fun e -> e.title = title) elements) ->
       let count = whole t Z.zero (Z.of_int max_int) count in
       header t format ({ title; count = Z.to_int count; properties = [] } :: elements)
     | "property" :: w, e :: before ->
       let p =
         match w with
         | ["list"; length; of_type; label] -> property t e.title of_type (Some length) label
         | [of_type; label] when of_type <> "list" -> property t e.title of_type None label
         | _ -> wrong t "expected a property" in
       if List.exists (fun o -> o.label = p.label) e.properties then wrong t "a property is there twice";
       header t format ({ e with properties = p :: e.properties } :: before)
     | _ -> wrong t "expected a line of a header")

(* Where values come from: the next one of a type, read as an integer or a real number, or skipped. *)
type source = { integer : kind * int -> Z.t; real : kind * int -> float; skip : kind * int -> unit }

let range (kind, size) =
  let all = Z.shift_left Z.one (8 * size) in
  if kind = Unsigned then (Z.zero, Z.pred all) else (Z.neg (Z.shift_right all 1), Z.pred (Z.shift_right all 1))

let exact t z =
  let x = Z.to_float z in
  if Z.equal (Z.of_float x) z then x else wrong t "an integer is no double"

let ascii_source t next_word =
  let integer k = let low, high = range k in whole t low high (next_word ()) in
  let real (kind, size) = if kind = Real then decimal t (size = 4) (next_word ()) else exact t (integer (kind, size)) in
  { integer; real; skip = (fun _ -> ignore (next_word ())) }

let binary_source t c big =
  let half at = Int32.to_int ((if big then String.get_int32_be else String.get_int32_le) c.bytes at) land mask in
  let integer (kind, size) =
    let at = Input.skip c size in
    let n =
      if size = 8 then
        let first = Z.of_int (half at) and second = Z.of_int (half (at + 4)) in
        if big then Z.add (Z.shift_left first 32) second else Z.add first (Z.shift_left second 32)
      else if size = 4 then Z.of_int (half at)
      else if size = 2 then Z.of_int ((if big then String.get_uint16_be else String.get_uint16_le) c.bytes at)
      else Z.of_int (Char.code c.bytes.[at]) in
    if kind = Signed then Z.signed_extract n 0 (8 * size) else n
  in
  let real (kind, size) =
    if kind <> Real then exact t (integer (kind, size))
    else
      let at = Input.skip c size in
      if size = 4 then Int32.float_of_bits (Int32.of_int (half at))
      else Int64.float_of_bits ((if big then String.get_int64_be else String.get_int64_le) c.bytes at)
  in
  { integer; real; skip = (fun (_, size) -> ignore (Input.skip c size)) }

let read_ply data file =
  let t = { data; file; from = 0; number = 0 } in
  if line t <> Some "ply" then wrong t "expected ply";
  let format, elements = header t "" [] in
  let ascii = format = "ascii" and rest = ref [] in
  let c = { bytes = data; at = t.from; name = file; offset = 0 } in
  let next_word () = match !rest with w :: r -> rest := r; w | [] -> wrong t "the line ends within an entry" in
  let source = if ascii then ascii_source t next_word else binary_source t c (format = "binary_big_endian") in
  let vertices = match List.find_opt (fun e -> e.title = "vertex") elements with Some e -> e.count | None -> -1 in
  let raw = { faces = []; edges = []; points = [] } in
  if vertices < 0 || vertices > mask then wrong t "expected an element vertex, of below 2^32 vertices";
  let least p = snd (Option.value p.length ~default:p.of_type) in
  let fits e =
    if ascii then e.count <= (String.length data - t.from + 1) / 2
    else e.count <= left c / max 1 (List.fold_left (fun n p -> n + least p) 0 e.properties) in
  let x = ref [||] in
  let vertex k =
    let v = source.integer k in
    if Z.sign v < 0 || Z.geq v (Z.of_int vertices) then wrong t "a vertex that is not there is named" else Z.to_int v in
  let real k =
    let v = source.real k in
    if is_finite v then v else wrong t "expected a finite number" in
  let value i corners p =
    match p.use with
    | Nothing -> source.skip p.of_type; corners
    | Axis k -> !x.((3 * i) + k) <- real p.of_type; corners
    | First -> corners @ [vertex p.of_type]
    | Corners | Second -> vertex p.of_type :: corners in
  let property i corners p =
    let n = match p.length with None -> Z.one | Some k -> source.integer k in
    if Z.sign n < 0 || Z.gt n (Z.of_int (String.length data)) then wrong t "a list has an impossible length";
    let rec values corners n = if n = 0 then corners else values (value i corners p) (n - 1) in
    values corners (Z.to_int n) in
  let rec next_line () =
    match line t with
    | None -> wrong t "the file ends within an element"
    | Some l -> rest := words l; if !rest = [] then next_line () in
  let entry e i =
    if ascii then next_line ();
    let corners = List.fold_left (property i) [] e.properties in
    if !rest <> [] then wrong t "expected the end of the line";
    if e.title = "face" && corners = [] then wrong t "a face without vertices";
    polygon raw (List.rev corners) in
  let read e =
    if e.count > 0 && not (fits e) then wrong t ("the file is too short for its element " ^ e.title);
    if e.title = "vertex" then x := Array.make (3 * e.count) 0.0;
    for i = 0 to e.count - 1 do entry e i done in
  List.iter read elements;
  if ascii then blank_lines t else finish c;
  frame raw vertices !x

let read_frame file =
  let channel = open_in_bin file and all = Buffer.create 65536 and part = Bytes.create 65536 in
  let rec read () =
    let n = input channel part 0 65536 in
    if n > 0 then (Buffer.add_subbytes all part 0 n; read ()) in
  read ();
  close_in channel;
  let data = Buffer.contents all and n = String.length file in
  if data = "" then reject file "is empty";
  match String.lowercase_ascii (String.sub file (max 0 (n - 4)) (min n 4)) with
  | ".ply" -> read_ply data file
  | ".obj" -> read_obj data file
  | _ -> reject file "expected a name that ends in .ply or .obj"
