// switchyard/trajectory/kinematic_trajectory_optimization.hpp - the best trajectory of one B-spline
// whose duration is free.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "switchyard/dynamics/rigid_body_model.hpp"
#include "switchyard/model/program.hpp"
#include "switchyard/solve/solve.hpp"
#include "switchyard/trajectory/bspline_trajectory.hpp"

namespace switchyard {

struct KinematicTrajectory;
struct SideRows;  // what these are made of
class PowerRows;
class CurvePoint;

/// q(t) = r(t / T) for t in [0, T] seconds, with a path r(s) = sum_j p_j B_j(s), s in [0, 1]. The
/// decision variables are the control points p_j, the columns of P in R^{n x N}, column by column,
/// then the duration T >= 0.
///
/// The k-th derivative of r is a B-spline, too, with the control points P M_k, M_k that of
/// BsplineBasis::DerivativeMap: it is in their hull, and that of q is T^-k times it. So bounds of
/// derivatives are asked of control points, and hold at all times; and they are rows of T^k, which
/// divide by nothing. Those of velocity are linear, those of acceleration and jerk polynomials with
/// derivatives in closed form, scaled by T_0^-k, T_0 the duration of the initial guess.
///
/// What is asked at a normalized time s stands for the time s T, and binds the control points alone
/// whose functions are not zero there: spline_order of them, fewer at the ends.
///
/// Vectors of bounds have num_positions() entries, and an infinite side is free. What is called
/// with a mistake (a size that does not fit, bounds that are crossed, s outside of [0, 1], a number
/// that is NaN) throws InvalidArgument and changes nothing. Bounds that exclude each other, such as
/// a start outside of the position bounds, are found by the solver: the answer is infeasible. Not
/// thread-safe while it changes; const use is.
///
/// (Derivatives of B-splines: Piegl and Tiller, The NURBS Book, 3.3.)
class SWITCHYARD_EXPORT KinematicTrajectoryOptimization final {
 public:
  /// On clamped uniform knots. The initial guess is zero at all times, for `duration` seconds.
  /// Throws where there is no position, the order is below 1, there are fewer control points than
  /// the order, or the duration is not above 0 and finite.
  KinematicTrajectoryOptimization(int num_positions, int num_control_points, int spline_order = 4,
                                  double duration = 1.0);
  /// On the trajectory's knots, taken from its times to [0, 1]; it is the initial guess.
  explicit KinematicTrajectoryOptimization(const BsplineTrajectory<double>& trajectory);
  KinematicTrajectoryOptimization(const KinematicTrajectoryOptimization&) = delete;
  KinematicTrajectoryOptimization& operator=(const KinematicTrajectoryOptimization&) = delete;
  ~KinematicTrajectoryOptimization();

  [[nodiscard]] int num_positions() const { return static_cast<int>(control_points_.rows()); }
  [[nodiscard]] int num_control_points() const { return static_cast<int>(control_points_.cols()); }
  /// Of r, over [0, 1].
  [[nodiscard]] const BsplineBasis<double>& basis() const { return basis_; }
  /// P, n x N.
  [[nodiscard]] const MatrixXDecisionVariable& control_points() const { return control_points_; }
  [[nodiscard]] Variable duration() const { return duration_; }
  [[nodiscard]] const MathematicalProgram& prog() const { return program_; }
  [[nodiscard]] MathematicalProgram& get_mutable_prog() { return program_; }

  /// Stand for q, dq/dt and d^2 q/dt^2 at a time that a call names, n each. They are no variables
  /// of prog().
  [[nodiscard]] const VectorXDecisionVariable& q() const { return placeholders_[0]; }
  [[nodiscard]] const VectorXDecisionVariable& qdot() const { return placeholders_[1]; }
  [[nodiscard]] const VectorXDecisionVariable& qddot() const { return placeholders_[2]; }

  // ---- Guess and answer ----

  /// The trajectory's path and duration; times count from its start. A B-spline on the knots of
  /// basis(), shifted and scaled, gives its control points; any other trajectory those of the path
  /// that meets it at the Greville abscissae, the means of spline_order - 1 consecutive inner knots
  /// (Schoenberg and Whitney, 1953: there is one, and one only). Rows that are scaled take the new
  /// duration. Throws where the trajectory is not a column of num_positions() or lasts no time.
  void SetInitialGuess(const Trajectory<double>& trajectory);
  /// q(t), from t = 0. Throws where the result has no point of prog(), or its duration vanishes: is
  /// at most 1e-9 of the guess.
  [[nodiscard]] BsplineTrajectory<double> ReconstructTrajectory(
      const MathematicalProgramResult& result) const;
  /// How far the bounds of position (0), velocity (1), acceleration (2) and jerk (3) that were
  /// added are from holding at control points, the largest of each, in units of q / s^k. Throws as
  /// ReconstructTrajectory does.
  [[nodiscard]] std::vector<double> BoundViolation(const MathematicalProgramResult& result) const;
  /// Solves prog() with the best backend, or the one given, from the initial guess. What is found
  /// is a value, also that there is nothing.
  [[nodiscard]] KinematicTrajectory FindTrajectory(const SolverOptions& options = {},
                                                   const SolverInterface* solver = nullptr) const;

  // ---- At a normalized time s ----

  /// lb <= r(s) <= ub. At an end of clamped knots, bounds of variables.
  Binding<LinearConstraint> AddPathPositionConstraint(const VectorRef& lb, const VectorRef& ub,
                                                      double s);
  /// Of n variables, for r(s). Rows stay rows, and cones cones.
  Binding<Constraint> AddPathPositionConstraint(const std::shared_ptr<Constraint>& constraint,
                                                double s);
  /// lb <= dr/ds(s) <= ub: of the path, whose velocity in time is this over T.
  Binding<LinearConstraint> AddPathVelocityConstraint(const VectorRef& lb, const VectorRef& ub,
                                                      double s);
  /// lb <= d^2 r/ds^2(s) <= ub.
  Binding<LinearConstraint> AddPathAccelerationConstraint(const VectorRef& lb, const VectorRef& ub,
                                                          double s);
  /// Of 2 n variables, for (q, dq/dt) at s. Divides by T: throws where no bound keeps it above 0
  /// (see AddDurationConstraint).
  Binding<Constraint> AddVelocityConstraintAtNormalizedTime(
      const std::shared_ptr<Constraint>& constraint, double s);
  /// Of some of qdot(): lb T <= A dr/ds(s) and A dr/ds(s) <= ub T, one binding for each side that
  /// is finite somewhere, one for both where they are equal.
  std::vector<Binding<LinearConstraint>> AddVelocityConstraintAtNormalizedTime(
      const Binding<LinearConstraint>& binding, double s);

  // ---- At many normalized times, of the placeholders q(), qdot() and qddot() ----
  //
  // One binding for each time, in their order. A linear constraint of q() alone stays linear, as
  // cones and quadratic forms of it stay what they are; one of qdot() or of qddot() alone is rows
  // of T or T^2. All else is the function that it is, of P and T, with exact derivatives by the
  // chain rule; with qdot() or qddot() that divides by T, and the call throws where no bound keeps
  // T above 0. The evaluator is taken as it is now: later changes of its coefficients are not seen.

  std::vector<Binding<Constraint>> AddConstraintAtNormalizedTimes(
      const Binding<Constraint>& binding, const VectorRef& s);
  std::vector<Binding<Constraint>> AddConstraintAtNormalizedTimes(const FormulaList& formulas,
                                                                  const VectorRef& s);
  /// The sum of the cost at each time.
  std::vector<Binding<Cost>> AddCostAtNormalizedTimes(const Binding<Cost>& binding,
                                                      const VectorRef& s);
  std::vector<Binding<Cost>> AddCostAtNormalizedTimes(const Expression& e, const VectorRef& s);

  // ---- Bounds at all times ----

  /// lb <= T <= ub; without them 0 and infinity. Throws where one is negative.
  Binding<BoundingBoxConstraint> AddDurationConstraint(std::optional<double> lb,
                                                       std::optional<double> ub);
  /// Of each control point.
  std::vector<Binding<BoundingBoxConstraint>> AddPositionBounds(const VectorRef& lb,
                                                                const VectorRef& ub);
  /// T lb <= P M_1 <= T ub, joint by joint: for each the lower side, then the upper one. A side
  /// that is infinite is left out; two that are equal are one binding. So are the next two. They
  /// throw where that derivative is zero everywhere: where the order of the spline is too low.
  std::vector<Binding<LinearConstraint>> AddVelocityBounds(const VectorRef& lb,
                                                           const VectorRef& ub);
  /// T^2 lb <= P M_2 <= T^2 ub. A side that is 0 is linear.
  std::vector<Binding<Constraint>> AddAccelerationBounds(const VectorRef& lb, const VectorRef& ub);
  /// T^3 lb <= P M_3 <= T^3 ub.
  std::vector<Binding<Constraint>> AddJerkBounds(const VectorRef& lb, const VectorRef& ub);

  // ---- Of a robot, whose model has num_positions() joints ----

  /// Position and velocity bounds of its joints, where they have some.
  void AddJointLimits(const RigidBodyModel& model);
  /// lb <= tau <= ub for the efforts (torques, forces) of inverse dynamics at each s: functions of
  /// P and T with exact first and second derivatives. A side that is not given is the model's: the
  /// efforts of its joints, or their negatives. Joints without a finite side are left out. It
  /// divides by T: throws where no bound keeps T above 0, and where no joint has a finite side.
  /// Between these times nothing holds: see EffortViolation in efforts.hpp.
  std::vector<Binding<Constraint>> AddEffortBoundsAtNormalizedTimes(
      const RigidBodyModel& model, const VectorRef& s,
      const std::optional<Eigen::VectorXd>& lb = std::nullopt,
      const std::optional<Eigen::VectorXd>& ub = std::nullopt);
  /// lower <= o + R point <= upper in the world at s, for a frame with origin o and axes R: the
  /// point has the coordinates `point` in the frame. Metres.
  Binding<Constraint> AddFramePositionConstraint(
      const RigidBodyModel& model, const std::string& frame, const Eigen::Vector3d& lower,
      const Eigen::Vector3d& upper, double s,
      const Eigen::Vector3d& point = Eigen::Vector3d::Zero());
  /// The rotation from the axes D to those of the frame at s is by no more than `tolerance`
  /// radians, from 0 to below pi. For its angle f that is a row, smooth everywhere,
  ///
  ///   (1 - cos f) / (2 sin(tolerance / 2)) <= sin(tolerance / 2),   1 - cos f = (3 - tr D'R) / 2,
  ///
  /// of slope cos(tolerance / 2) where f = tolerance. Its slope vanishes at f = 0, so a tolerance
  /// of 0 is sin(f) axis = 0, half the differences across the diagonal of D'R, and cos f >= 0.
  /// Throws where `axes` is no rotation to 1e-6.
  Binding<Constraint> AddFrameOrientationConstraint(const RigidBodyModel& model,
                                                    const std::string& frame,
                                                    const Eigen::Matrix3d& axes, double tolerance,
                                                    double s);
  /// Distances of the pairs are no less than `distance` metres at each s; without pairs those of
  /// all. Second derivatives are differences of gradients: see DistanceFunction. Between these
  /// times nothing holds. Throws where the model has no pairs.
  std::vector<Binding<Constraint>> AddMinimumDistanceConstraint(
      const RigidBodyModel& model, double distance, const VectorRef& s,
      const std::optional<std::vector<int>>& pairs = std::nullopt);

  // ---- Costs; weights are 0 or more, but for that of the duration ----

  /// weight T.
  Binding<LinearCost> AddDurationCost(double weight = 1.0);
  /// sum_j weight |p_j - p_{j-1}|, no less than weight times the length of the path; one binding
  /// for each j. With `use_conic_constraint` each is a new variable in a Lorentz cone.
  std::vector<Binding<Cost>> AddPathLengthCost(double weight = 1.0,
                                               bool use_conic_constraint = false);
  /// sum_j weight |p_j - p_{j-1}|^2, one binding for each j. Alone it spaces control points evenly
  /// along the path.
  std::vector<Binding<Cost>> AddPathEnergyCost(double weight = 1.0);
  /// The integral of the cost of q(), qdot() and qddot() over time, from 0 to T; by `points` Gauss
  /// and Legendre's nodes for each interval between knots, exact for polynomials in s of degree
  /// 2 points - 1 there. One binding for each node.
  std::vector<Binding<Cost>> AddTimeIntegralCost(const Binding<Cost>& binding, int points = 3);
  std::vector<Binding<Cost>> AddTimeIntegralCost(const Expression& e, int points = 3);
  /// Likewise over s, from 0 to 1.
  std::vector<Binding<Cost>> AddPathIntegralCost(const Binding<Cost>& binding, int points = 3);
  std::vector<Binding<Cost>> AddPathIntegralCost(const Expression& e, int points = 3);

 private:
  /// lb <= d^k q / dt^k <= ub, as it was asked for.
  struct Bound {
    int derivative_order;
    Eigen::VectorXd lower;
    Eigen::VectorXd upper;
  };
  /// lb <= tau <= ub likewise.
  struct EffortBound {
    RigidBodyModel model;
    Eigen::VectorXd lower;
    Eigen::VectorXd upper;
  };
  struct Answer {
    Eigen::MatrixXd points;
    double duration;
  };
  KinematicTrajectoryOptimization(int num_positions, BsplineBasis<double> basis, double duration);
  [[nodiscard]] Answer AnswerOf(const std::string& call,
                                const MathematicalProgramResult& result) const;
  [[nodiscard]] Eigen::MatrixXd PointsThrough(const Trajectory<double>& trajectory) const;
  void CheckBounds(const std::string& call, const VectorRef& lb, const VectorRef& ub) const;
  [[nodiscard]] double LeastDuration() const;
  void RequireDuration(const std::string& call) const;
  [[nodiscard]] CurvePoint PointOf(const std::string& call,
                                   const VectorXDecisionVariable& placeholders, double s) const;
  [[nodiscard]] VectorXDecisionVariable VariablesOf(const CurvePoint& at, bool with_duration) const;
  Binding<LinearConstraint> AddPathRows(const std::string& call, const VectorRef& lb,
                                        const VectorRef& ub, double s, int derivative_order);
  template <class C, class Make>
  std::vector<Binding<C>> AddDerivativeBounds(const std::string& call, const Bound& bound,
                                              const Make& make);
  [[nodiscard]] std::shared_ptr<Constraint> MakePowerRows(const SideRows& rows, int k);
  [[nodiscard]] Binding<Constraint> ConstraintAt(const std::string& call,
                                                 const Binding<Constraint>& binding, double s);
  [[nodiscard]] Binding<Cost> CostAt(const std::string& call, const Binding<Cost>& binding,
                                     double s, double weight = 1, bool timed = false) const;
  std::vector<Binding<Cost>> AddIntegral(const std::string& call, const Binding<Cost>& binding,
                                         int points, bool timed);
  void CheckModel(const std::string& call, const RigidBodyModel& model) const;
  /// lb <= f <= ub of some placeholders, at each s.
  std::vector<Binding<Constraint>> AddFunction(const std::string& call,
                                               const std::string& description,
                                               std::shared_ptr<const Function> f,
                                               const VectorRef& lb, const VectorRef& ub,
                                               const VariableList& placeholders,
                                               const VectorRef& s);

  BsplineBasis<double> basis_;
  MathematicalProgram program_;
  MatrixXDecisionVariable control_points_;
  Variable duration_;
  std::vector<VectorXDecisionVariable> placeholders_;  // by derivative
  std::vector<std::shared_ptr<const NameBlock>> names_;
  double guessed_duration_;  // T_0
  std::vector<std::shared_ptr<PowerRows>> scaled_;
  std::vector<Bound> bounds_;
  std::vector<EffortBound> effort_bounds_;
};

/// What FindTrajectory finds.
struct KinematicTrajectory {
  std::optional<BsplineTrajectory<double>> trajectory;  // where there is a point
  /// A duration that vanishes is numerical trouble, and a note.
  MathematicalProgramResult result;
  /// See BoundViolation; empty where there is no trajectory.
  std::vector<double> bound_violation;
  /// The largest EffortViolation of the effort bounds that were added, at 20 times for each control
  /// point.
  double effort_violation = 0;
};

}  // namespace switchyard
