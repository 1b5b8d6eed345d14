(* SPDX-License-Identifier: Apache-2.0 *)
(* Extracted from Poly.v by build.sh --renew: not to be edited. *)

type poly = Zint.t list

(** val add : poly -> poly -> poly **)

let rec add p q =
  match p with
  | [] -> q
  | a :: p' ->
    (match q with
     | [] -> p
     | b :: q' -> (Zint.add a b) :: (add p' q'))

(** val scale : Zint.t -> poly -> poly **)

let scale c p =
  List.map (fun a -> Zint.mul c a) p

(** val sub : poly -> poly -> poly **)

let sub p q =
  add p (scale (Zint.neg Zint.one) q)

(** val mul : poly -> poly -> poly **)

let rec mul p q =
  match p with
  | [] -> []
  | a :: p' -> add (scale a q) (Zint.zero :: (mul p' q))

(** val trim : poly -> poly **)

let rec trim = function
| [] -> []
| a :: r ->
  (match trim r with
   | [] -> if Zint.equal a Zint.zero then [] else a :: []
   | z :: l -> a :: (z :: l))

(** val blend : Zint.t -> Zint.t -> Zint.t list -> Zint.t list **)

let blend l u f =
  add (List.append (scale l f) (Zint.zero :: [])) (Zint.zero :: (scale u f))

(** val forms :
    Zint.t -> Zint.t -> Zint.t -> poly -> Zint.t list * Zint.t list **)

let rec forms l u d = function
| [] -> ([], (Zint.one :: []))
| c :: r ->
  let fe = forms l u d r in
  ((add (scale c (snd fe)) (blend l u (fst fe))), (blend d d (snd fe)))

(** val bernstein : Zint.t -> Zint.t -> Zint.t -> poly -> Zint.t list **)

let bernstein l u d p =
  fst (forms l u d (trim p))

(** val nonnegative_on : Zint.t -> Zint.t -> Zint.t -> poly -> bool **)

let nonnegative_on l u d p =
  List.for_all (fun a -> Zint.leq Zint.zero a) (bernstein l u d p)

(** val positive_on : Zint.t -> Zint.t -> Zint.t -> poly -> bool **)

let positive_on l u d p =
  match bernstein l u d p with
  | [] -> false
  | z :: l0 -> List.for_all (fun a -> Zint.lt Zint.zero a) (z :: l0)

(** val last_of : Zint.t -> Zint.t list -> Zint.t **)

let rec last_of a = function
| [] -> a
| b :: r' -> last_of b r'

(** val changes_sign : Zint.t -> Zint.t -> Zint.t -> poly -> bool **)

let changes_sign l u d p =
  match bernstein l u d p with
  | [] -> false
  | a :: r -> Zint.leq (Zint.mul a (last_of a r)) Zint.zero

(** val cancel :
    Zint.t -> Zint.t -> Zint.t list -> Zint.t list -> Zint.t list option **)

let rec cancel b a f g =
  match f with
  | [] -> (match g with
           | [] -> Some (scale b f)
           | _ :: _ -> None)
  | x :: f' ->
    (match g with
     | [] -> Some (scale b f)
     | y :: g' ->
       (match cancel b a f' g' with
        | Some h -> Some ((Zint.sub (Zint.mul b x) (Zint.mul a y)) :: h)
        | None -> None))

(** val reduces :
    Zint.t list -> Zint.t -> Zint.t list -> Zint.t list -> bool **)

let rec reduces fuel b g f = match f with
| [] -> true
| a :: f' ->
  (match cancel b a f' g with
   | Some h -> (match fuel with
                | [] -> false
                | _ :: k -> reduces k b g h)
   | None -> List.for_all (fun c -> Zint.equal c Zint.zero) f)

(** val divides : poly -> poly -> bool **)

let divides g p =
  match List.rev_append g [] with
  | [] -> false
  | b :: g' ->
    if Zint.equal b Zint.zero
    then false
    else let f = List.rev_append p [] in reduces f b g' f
