(* SPDX-License-Identifier: Apache-2.0 *)
(* Bytes that are read one after another, exact numbers, checksums, and block files (trajectory/FORMAT.md).
   Nothing here knows what the bytes are about. *)

(* The check ends: in which file, where, and why. *)
exception Rejected of string

(* Each read is within the bytes, or rejected. *)
type cursor = { bytes : string; mutable at : int; file : string; offset : int }

let cursor file offset bytes = { bytes; at = 0; file; offset }
let fail c why = raise (Rejected (Printf.sprintf "%s, byte %d: %s" c.file (c.offset + c.at) why))
let check c holds why = if not holds then fail c why
let left c = String.length c.bytes - c.at
let need c count size = check c (count <= left c / size) "a length does not fit into what is left"
let skip c n = need c n 1; c.at <- c.at + n; c.at - n  (* where they begin *)
let finish c = check c (left c = 0) "expected the end here"
let take c n = let at = skip c n in String.sub c.bytes at n
let many n part c = Array.init n (fun _ -> part c)
let both part c = let a = part c in (a, part c)
let mask = 0xffffffff
let u8 c = Char.code c.bytes.[skip c 1]
let u16 c = String.get_uint16_le c.bytes (skip c 2)
let i32 c = Int32.to_int (String.get_int32_le c.bytes (skip c 4))
let u32 c = i32 c land mask

(* Nothing that is 2^62 or more can be right: it counts what takes bytes. *)
let small c z = if Z.fits_int z then Z.to_int z else fail c "a number is too large"
let u64 c = small c (Z.of_bits (take c 8))
let finite c (x : float) = check c (x -. x = 0.0) "expected a finite number"; x
let f64 c = finite c (Int64.float_of_bits (String.get_int64_le c.bytes (skip c 8)))

(* The next n numbers are finite; they stay where they are. *)
let finite_numbers c n =
  let there = Int.min n (left c / 8) in
  for _ = 1 to there do
    let bits = String.get_int64_le c.bytes c.at in c.at <- c.at + 8;
    check c (Int64.to_int (Int64.shift_right_logical bits 52) land 0x7ff < 0x7ff) "expected a finite number"
  done;
  need c (n - there) 8

let same_bits x y = Int64.equal (Int64.bits_of_float x) (Int64.bits_of_float y)

(* How many pairs a <= b, and they, ascending strictly. *)
let pairs part c =
  let n = u32 c in need c n 4;
  let all = many n (both part) c in
  Array.iteri (fun i (a, b) -> check c (a <= b && (i = 0 || all.(i - 1) < (a, b))) "pairs are not in order") all;
  Array.to_list all

(* Groups of seven bits, the lowest first, at most so many: none is there without need. *)
let rec groups c most is_first =
  let byte = u8 c in
  check c ((byte > 0 || is_first) && (byte < 128 || most > 1)) "an integer is too long, or does not end";
  let rest = if byte < 128 then Z.zero else groups c (most - 1) false in
  Z.logor (Z.of_int (byte land 127)) (Z.shift_left rest 7)

let uint c = small c (groups c 10 true)
let sint c = let u = groups c 1200 true in Z.logxor (Z.shift_right u 1) (if Z.is_odd u then Z.minus_one else Z.zero)
let shift c = let s = uint c in check c (s <= 4096) "a shift is above 4,096"; s
let scaled c = let s = shift c in Z.shift_left (sint c) s

(* The bits of a finite binary64 number: it is plus or minus significand 2^unit. *)
let biased bits = Int64.to_int (Int64.shift_right_logical bits 52) land 0x7ff
let significand bits = (Int64.to_int bits land 0xfffffffffffff) lor (if biased bits = 0 then 0 else 0x10000000000000)
let unit bits = Int.max 1 (biased bits) - 1075

(* x / 2^p is an integer: digits 2^zeros. *)
let is_multiple p bits =
  let m = significand bits and k = unit bits - p in
  k >= 0 || m = 0 || (k > -53 && m land ((1 lsl -k) - 1) = 0)
let zeros p bits = Int.max 0 (unit bits - p)
let digits p bits =
  let k = unit bits - p in
  let m = if k >= 0 then significand bits else if k > -53 then significand bits lsr -k else 0 in
  if Int64.compare bits 0L < 0 then -m else m
let exact p bits =
  let m = digits p bits and k = zeros p bits in
  if k < 9 then Z.of_int (m lsl k) else Z.shift_left (Z.of_int m) k

let check_multiple c p bits = check c (is_multiple p bits) "a number is no multiple of the step's unit"
let integer c p x = let bits = Int64.bits_of_float x in check_multiple c p bits; exact p bits

(* CRC-32C, eight bytes at once: number 256 k + byte is the remainder of that byte with k bytes of 0 behind it. *)
let crc_table =
  let bit c _ = (c lsr 1) lxor (if c land 1 = 1 then 0x82F63B78 else 0) in
  let table = Array.init 2048 (fun i -> List.fold_left bit (i land 255) [1; 2; 3; 4; 5; 6; 7; 8]) in
  for i = 256 to 2047 do let c = table.(i - 256) in table.(i) <- table.(c land 255) lxor (c lsr 8) done;
  table

let crc32c before s =
  let next crc byte = crc_table.((crc lxor byte) land 255) lxor (crc lsr 8) in
  let crc = ref before and whole = String.length s land -8 in
  for i = 0 to (whole / 8) - 1 do
    let x = Int64.logxor (String.get_int64_le s (8 * i)) (Int64.of_int !crc) in
    let low = Int64.to_int x and high = Int64.to_int (Int64.shift_right_logical x 32) in
    let at k word shift = crc_table.((256 * k) + ((word lsr shift) land 255)) in
    crc := at 7 low 0 lxor at 6 low 8 lxor at 5 low 16 lxor at 4 low 24
           lxor at 3 high 0 lxor at 2 high 8 lxor at 1 high 16 lxor at 0 high 24
  done;
  for i = whole to String.length s - 1 do crc := next !crc (Char.code s.[i]) done;
  !crc

(* SHA-256, FIPS 180-4. What is less than a block waits. *)
type hash = { state : int array; waits : Bytes.t; mutable hashed : int }

(* The first 32 fractional bits of roots of the first n primes. *)
let roots degree n =
  let is_prime n = List.for_all (fun d -> n = d || n mod d <> 0) [2; 3; 5; 7; 11; 13; 17] in
  let primes = Array.of_list (List.filter is_prime (List.init 310 (fun i -> i + 2))) in
  let root i = Z.root (Z.shift_left (Z.of_int primes.(i)) (32 * degree)) degree in
  Array.init n (fun i -> Z.to_int (Z.extract (root i) 0 32))

let start = roots 2 8
let hash () = { state = Array.copy start; waits = Bytes.create 64; hashed = 0 }

(* Most of a checker's time would go here, so words are in int64, which the compiler keeps unboxed within a function,
   with neither tags nor tests. Of 64 bits the lowest 32 count. A rotated word is a shifted one that was there twice.
   Indices of w and k, which are not tested, are multiples of 8 below 512. *)
module Compress = struct
  external get : Bytes.t -> int -> int64 = "%caml_bytes_get64u"
  external set : Bytes.t -> int -> int64 -> unit = "%caml_bytes_set64u"
  let ( ^ ) = Int64.logxor and ( & ) = Int64.logand and ( || ) = Int64.logor and ( >> ) = Int64.shift_right_logical
  let ( + ) = Int64.add
  let w = Bytes.create 512 and k = Bytes.create 512
  let () = Array.iteri (fun i x -> set k (8 * i) (Int64.of_int x)) (roots 3 64)
  let[@inline] twice x = let x = x & 0xffffffffL in x || Int64.shift_left x 32
  let[@inline] word i = get w (8 * i)

  (* Word i, of those before it. *)
  let[@inline] extend i =
    let x = word (i - 15) and y = word (i - 2) in
    let xx = twice x and yy = twice y in
    let s0 = (xx >> 7) ^ (xx >> 18) ^ (x >> 3) and s1 = (yy >> 17) ^ (yy >> 19) ^ (y >> 10) in
    set w (8 * i) ((word (i - 16) + word (i - 7) + s0 + s1) & 0xffffffffL)

  (* Unrolled, so that all indices are constants. *)
  let[@inline] extend_four i = extend i; extend (i lor 1); extend (i lor 2); extend (i lor 3)
  let[@inline] extend_all i = extend_four i; extend_four (i lor 4); extend_four (i lor 8); extend_four (i lor 12)

  let schedule s at =
    for i = 0 to 15 do
      set w (8 * i) (Int64.of_int32 (String.get_int32_be s (Stdlib.( + ) at (4 * i))) & 0xffffffffL)
    done;
    extend_all 16; extend_all 32; extend_all 48

  (* T1 and T2 of round i. What is known first is added first: a round waits for e of the one before. *)
  let[@inline] t1 e f g h i =
    (h + get k (8 * i) + word i) + (g ^ (e & (f ^ g))) + ((e >> 6) ^ (e >> 11) ^ (e >> 25))
  let[@inline] t2 a b c = ((a >> 2) ^ (a >> 13) ^ (a >> 22)) + ((a & b) || (c & (a || b)))

  let block v s at =
    schedule s at;
    let get i = twice (Int64.of_int v.(i)) in
    let a = ref (get 0) and b = ref (get 1) and c = ref (get 2) and d = ref (get 3) in
    let e = ref (get 4) and f = ref (get 5) and g = ref (get 6) and h = ref (get 7) in
    (* Four rounds at once: in each, two words change; then all have moved by four. *)
    for quarter = 0 to 15 do
      let i = 4 * quarter and a0 = !a and b0 = !b and c0 = !c and e0 = !e and f0 = !f and g0 = !g in
      let t = t1 e0 f0 g0 !h i in
      let d1 = twice (!d + t) and h1 = twice (t + t2 a0 b0 c0) in
      let t = t1 d1 e0 f0 g0 (i lor 1) in
      let c1 = twice (c0 + t) and g1 = twice (t + t2 h1 a0 b0) in
      let t = t1 c1 d1 e0 f0 (i lor 2) in
      let b1 = twice (b0 + t) and f1 = twice (t + t2 g1 h1 a0) in
      let t = t1 b1 c1 d1 e0 (i lor 3) in
      e := twice (a0 + t); f := b1; g := c1; h := d1;
      a := twice (t + t2 f1 g1 h1); b := f1; c := g1; d := h1
    done;
    let add i x = v.(i) <- Int64.to_int ((Int64.of_int v.(i) + x) & 0xffffffffL) in
    add 0 !a; add 1 !b; add 2 !c; add 3 !d; add 4 !e; add 5 !f; add 6 !g; add 7 !h
end

let add h s =
  let n = String.length s and used = h.hashed land 63 in
  let first = min n ((64 - used) land 63) in  (* these go to what waits *)
  Bytes.blit_string s 0 h.waits used first;
  if first > 0 && used + first = 64 then Compress.block h.state (Bytes.to_string h.waits) 0;
  let blocks = (n - first) / 64 in let rest = first + (64 * blocks) in
  for i = 0 to blocks - 1 do Compress.block h.state s (first + (64 * i)) done;
  Bytes.blit_string s rest h.waits 0 (n - rest); h.hashed <- h.hashed + n

(* So many bytes of an integer, the lowest first. *)
let text size n = String.init size (fun i -> Char.chr ((n lsr (8 * i)) land 255))
let reversed s = String.init (String.length s) (fun i -> s.[String.length s - 1 - i])

let digest h =
  add h ("\x80" ^ String.make ((119 - h.hashed) land 63) '\000' ^ reversed (text 8 (8 * h.hashed)));
  String.concat "" (List.map (fun x -> reversed (text 4 x)) (Array.to_list h.state))

(* A block file, with how many groups and bytes were read, and hashes of the open group, the last, and all. *)
type file = { name : string; channel : in_channel; size : int; mutable read : int; mutable commits : int;
              mutable is_open : bool; mutable group : hash; mutable last : string; mutable running : string }

let refuse f why = fail (cursor f.name f.read "") (Printf.sprintf "%s (%d commits)" why f.commits)

let read f n =
  if n > f.size - f.read then refuse f "a block, or its length, goes beyond the end of the file";
  f.read <- f.read + n; really_input_string f.channel n

let open_file name content =
  let channel = open_in_bin name and group = hash () and running = String.make 32 '\000' in
  let size = in_channel_length channel in
  let f = { name; channel; size; read = 0; commits = 0; is_open = true; group; last = ""; running } in
  let head = read f 16 in
  if head <> "\x89NOLI\r\n\x1a\001\000\000\000" ^ content then refuse f ("expected version 1, content " ^ content);
  add group head; f

let commit f c =
  let running = hash () in f.last <- digest f.group;
  add running (f.running ^ f.last); f.running <- digest running;
  check c (left c = 72 && u64 c = f.commits && take c 64 = f.last ^ f.running) "a commit has a wrong number or hash";
  f.group <- hash (); f.commits <- f.commits + 1

(* The kind and payload of the next block; "CMIT" for a commit, which was right; "" at the end, behind a commit. *)
let next f =
  if f.read = f.size && not f.is_open then ("", cursor f.name f.read "")
  else begin
    if f.size - f.read < 16 then refuse f "the file ends here without a commit";
    let head = read f 12 in
    let kind = String.sub head 0 4 and length = u64 (cursor f.name f.read (String.sub head 4 8)) in
    let c = cursor f.name f.read (read f length) and sum = read f 4 in
    if text 4 (crc32c (crc32c mask head) c.bytes lxor mask) <> sum then refuse f "the checksum is wrong";
    f.is_open <- kind <> "CMIT";
    if f.is_open then List.iter (add f.group) [head; c.bytes; sum] else commit f c;
    (kind, c)
  end

(* The payload of the next block, which has to be of that kind. *)
let expect f kind = let found, c = next f in check c (found = kind) ("expected a block " ^ kind ^ " here"); c
