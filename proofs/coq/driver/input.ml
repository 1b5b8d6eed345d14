(* SPDX-License-Identifier: Apache-2.0 *)
(* Bytes that are read one after another, the two checksums, and exact numbers.
   Nothing here knows what the bytes are about. *)

(* The check ends: where in which file, and why. *)
exception Rejected of string * string

let reject where why = raise (Rejected (where, why))

(* Each read is within the bytes, or rejected. *)
type cursor = { bytes : string; mutable at : int; name : string; offset : int }

let cursor name offset bytes = { bytes; at = 0; name; offset }
let left c = String.length c.bytes - c.at
let fail c why = reject (Printf.sprintf "%s, byte %d" c.name (c.offset + c.at)) why

(* Where so many bytes begin that are read now. *)
let skip c n =
  if n < 0 || n > left c then fail c (Printf.sprintf "expected %d more bytes, found %d" n (left c));
  c.at <- c.at + n;
  c.at - n

(* That many things of so many bytes each are left. *)
let need c count size =
  if count > left c / size then fail c (Printf.sprintf "a count of %d does not fit into what is left" count)

let finish c = if left c <> 0 then fail c (Printf.sprintf "expected the end here, found %d more bytes" (left c))
let take c n = let at = skip c n in String.sub c.bytes at n
let u8 c = let at = skip c 1 in Char.code c.bytes.[at]
let u16 c = let at = skip c 2 in String.get_uint16_le c.bytes at
let i32 c = let at = skip c 4 in Int32.to_int (String.get_int32_le c.bytes at)
let u32 c = i32 c land 0xffffffff

(* Nothing that is 2^62 or more can be right: it counts bytes, or what has some. *)
let u64 c =
  let at = skip c 8 in
  let n = String.get_int64_le c.bytes at in
  if Int64.shift_right_logical n 62 <> 0L then fail c "a number is too large" else Int64.to_int n

let is_finite (x : float) = x -. x = 0.0

let f64 c =
  let at = skip c 8 in
  let x = Int64.float_of_bits (String.get_int64_le c.bytes at) in
  if is_finite x then x else fail c "expected a finite number"

let same_bits x y = Int64.equal (Int64.bits_of_float x) (Int64.bits_of_float y)

(* Groups of seven bits, the lowest first: their number, which is as small as it can be. *)
let groups c most =
  let n = ref 1 in
  while !n <= most && !n <= left c && Char.code c.bytes.[c.at + !n - 1] >= 0x80 do incr n done;
  if !n > most || !n > left c then fail c "an integer does not end";
  if !n > 1 && c.bytes.[c.at + !n - 1] = '\000' then fail c "an integer is written longer than it is";
  !n

(* The integer of the groups from one to before another, at most eight. *)
let rec groups_value c first last =
  if first = last then 0
  else Char.code c.bytes.[first] land 0x7f lor (groups_value c (first + 1) last lsl 7)

(* All that a uint is for is far below 2^56. *)
let uint c =
  let n = groups c 10 in
  if n > 8 then fail c "an integer is too large for its place";
  let at = skip c n in
  groups_value c at (at + n)

let sint c =
  let n = groups c 1200 in
  let start = skip c n in
  let rec value last high =
    if last = start then high
    else
      let first = max start (last - 8) in
      value first (Z.add (Z.shift_left high (7 * (last - first))) (Z.of_int (groups_value c first last)))
  in
  let u = value (start + n) Z.zero in
  if Z.is_odd u then Z.lognot (Z.shift_right u 1) else Z.shift_right u 1

let shift c = let s = uint c in if s > 4096 then fail c "a shift is above 4,096" else s
let scaled c = let s = shift c in Z.shift_left (sint c) s

(* A double is m 2^e with an integer m below 2^53: |m|, e. *)
let split x =
  let bits = Int64.bits_of_float x in
  let e = Int64.to_int (Int64.shift_right_logical bits 52) land 0x7ff and m = Int64.to_int bits land 0xfffffffffffff in
  if e = 0 then (m, -1074) else (m lor 0x10000000000000, e - 1075)

(* Whether x / 2^p is an integer. *)
let is_multiple p x =
  let m, e = split x in
  e >= p || m = 0 || (p - e <= 52 && m land ((1 lsl (p - e)) - 1) = 0)

(* That integer. *)
let integer p x =
  let m, e = split x in
  let m = if x < 0.0 then -m else m in
  if m = 0 then Z.zero
  else if e < p then Z.of_int (m asr (p - e))
  else if e - p < 9 then Z.of_int (m lsl (e - p))
  else Z.shift_left (Z.of_int m) (e - p)

let mask = 0xffffffff

(* CRC-32C, eight bytes at a time. *)
let crc_table =
  let table = Array.make 2048 0 in
  for i = 0 to 2047 do
    let c = ref (if i < 256 then i else table.(i - 256)) in
    for _ = 1 to 8 do c := (!c lsr 1) lxor (if !c land 1 = 1 then 0x82F63B78 else 0) done;
    table.(i) <- !c
  done;
  table

let crc32c strings =
  let add crc s =
    let crc = ref crc and t = crc_table and n = String.length s / 8 * 8 and at = ref 0 in
    while !at < n do
      let a = Int32.to_int (String.get_int32_le s !at) lxor !crc and b = Int32.to_int (String.get_int32_le s (!at + 4)) in
      crc := t.(1792 + (a land 255)) lxor t.(1536 + ((a lsr 8) land 255))
             lxor t.(1280 + ((a lsr 16) land 255)) lxor t.(1024 + ((a lsr 24) land 255))
             lxor t.(768 + (b land 255)) lxor t.(512 + ((b lsr 8) land 255))
             lxor t.(256 + ((b lsr 16) land 255)) lxor t.((b lsr 24) land 255);
      at := !at + 8
    done;
    for i = n to String.length s - 1 do crc := t.((!crc lxor Char.code s.[i]) land 255) lxor (!crc lsr 8) done;
    !crc
  in
  List.fold_left add mask strings lxor mask

(* SHA-256, FIPS 180-4. Its constants are the first 32 fractional bits of roots of primes. *)
module Sha256 = struct
  let primes =
    let is_prime n = not (List.exists (fun d -> d < n && n mod d = 0) [2; 3; 5; 7; 11; 13; 17]) in
    Array.of_list (List.filter is_prime (List.init 310 (fun i -> i + 2)))

  let root_bits degree p = Z.to_int (Z.extract (Z.root (Z.shift_left (Z.of_int p) (32 * degree)) degree) 0 32)
  let k = Array.map (root_bits 3) primes

  type t = { state : int array; w : int array; block : Bytes.t; mutable used : int; mutable size : int }

  let create () =
    { state = Array.map (root_bits 2) (Array.sub primes 0 8); w = Array.make 64 0; block = Bytes.create 64; used = 0;
      size = 0 }

  let rec rounds w i a b c d e f g h =
    if i = 64 then [| a; b; c; d; e; f; g; h |]
    else
      (* Twice the same 32 bits one behind the other: shifted, they are rotated. *)
      let ee = e lor (e lsl 32) and aa = a lor (a lsl 32) in
      let t1 = h + (((ee lsr 6) lxor (ee lsr 11) lxor (ee lsr 25)) land mask) + (g lxor (e land (f lxor g))) + k.(i) + w.(i)
      and t2 = (((aa lsr 2) lxor (aa lsr 13) lxor (aa lsr 22)) land mask) + ((a land b) lor (c land (a lor b))) in
      rounds w (i + 1) ((t1 + t2) land mask) a b c ((d + t1) land mask) e f g

  let compress h s at =
    let w = h.w and v = h.state in
    for i = 0 to 15 do w.(i) <- Int32.to_int (String.get_int32_be s (at + (4 * i))) land mask done;
    for i = 16 to 63 do
      let x = w.(i - 15) and y = w.(i - 2) in
      let xx = x lor (x lsl 32) and yy = y lor (y lsl 32) in
      let s0 = (xx lsr 7) lxor (xx lsr 18) lxor (x lsr 3) and s1 = (yy lsr 17) lxor (yy lsr 19) lxor (y lsr 10) in
      w.(i) <- (w.(i - 16) + (s0 land mask) + w.(i - 7) + (s1 land mask)) land mask
    done;
    let r = rounds w 0 v.(0) v.(1) v.(2) v.(3) v.(4) v.(5) v.(6) v.(7) in
    Array.iteri (fun i x -> v.(i) <- (v.(i) + x) land mask) r

  (* The n bytes of s from a place on. *)
  let rec add_part h s at n =
    if h.used = 0 && n >= 64 then (compress h s at; h.size <- h.size + 64; add_part h s (at + 64) (n - 64))
    else if n > 0 then begin
      let now = min n (64 - h.used) in
      Bytes.blit_string s at h.block h.used now;
      h.used <- (h.used + now) land 63;
      h.size <- h.size + now;
      if h.used = 0 then compress h (Bytes.unsafe_to_string h.block) 0;
      add_part h s (at + now) (n - now)
    end

  let add h s = add_part h s 0 (String.length s)

  let digest h =
    let tail = Bytes.make (8 + ((119 - h.used) land 63 + 1)) '\000' in
    Bytes.set tail 0 '\x80';
    Bytes.set_int64_be tail (Bytes.length tail - 8) (Int64.of_int (8 * h.size));
    add h (Bytes.unsafe_to_string tail);
    String.init 32 (fun i -> Char.chr ((h.state.(i / 4) lsr (24 - (8 * (i mod 4)))) land 255))
end

(* Bytes of a hash, gathered before they are hashed. *)
type sink = { hash : Sha256.t; buffer : Bytes.t; mutable fill : int }

let sink () = { hash = Sha256.create (); buffer = Bytes.create 65536; fill = 0 }

let flush_sink s =
  Sha256.add_part s.hash (Bytes.unsafe_to_string s.buffer) 0 s.fill;
  s.fill <- 0

let room s n =
  if s.fill + n > Bytes.length s.buffer then flush_sink s;
  s.fill <- s.fill + n;
  s.fill - n

let put_u8 s n = let at = room s 1 in Bytes.set_uint8 s.buffer at n
let put_u32 s n = let at = room s 4 in Bytes.set_int32_le s.buffer at (Int32.of_int n)
let put_u64 s n = let at = room s 8 in Bytes.set_int64_le s.buffer at (Int64.of_int n)

(* -0 becomes +0. *)
let put_f64 s x = let at = room s 8 in Bytes.set_int64_le s.buffer at (Int64.bits_of_float (x +. 0.0))
let sink_digest s = flush_sink s; Sha256.digest s.hash
