;; The tower a-b-c stands the wrong way round, and d is under e.

(defproblem towers blocks
 ((on a b) (on b c) (on-table c) (clear a)
  (on e d) (on-table d) (clear e)
  (goal-on c b) (goal-on b a) (goal-on a d) (goal-on-table d))
 ((arrange)))
