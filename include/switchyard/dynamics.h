/* switchyard/dynamics.h - rigid-body dynamics as a table of a plugin: "sy.dynamics/1".
 *
 * A model is a tree of bodies and joints, read from a file, with n coordinates q whose rates are
 * the velocities v = dq/dt: revolute, continuous and prismatic joints, one coordinate each, in the
 * order of the file's joints from the root outwards. Other joints (free, ball, planar) are refused
 * at the load by name. Units are those of the file: metres, radians, kilograms, seconds, newtons.
 *
 * Matrices are column-major. Poses are in the world's frame. Every function may be called from any
 * thread, several at once on one model. Nothing of C++ crosses; errors are as in abi.h.
 */
#ifndef SY_DYNAMICS_H_
#define SY_DYNAMICS_H_

#include "switchyard/abi.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct sy_dynamics_model sy_dynamics_model; /* owned by the plugin */

typedef int32_t sy_model_format;
enum { SY_MODEL_URDF = 0, SY_MODEL_MJCF = 1 };

typedef struct sy_dynamics_source { /* record: what to load */
  uint32_t size;
  sy_model_format format;
  const char* path; /* of the file; NULL: `text` is its content */
  const char* text;
  const char* const* packages; /* num_packages folders where package://... is looked for */
  int32_t num_packages;
  int32_t num_locked; /* joints that are fixed, as if welded at a position */
  const char* const* locked;
  const double* locked_position; /* num_locked */
  double gravity[3];             /* m/s^2; NaN in the first: the file's own, else (0, 0, -9.81) */
  int32_t geometry;              /* not 0: load collision geometry too, for distances */
  int32_t reserved;
} sy_dynamics_source;

typedef int32_t sy_joint_type;
enum { SY_JOINT_REVOLUTE = 0, SY_JOINT_CONTINUOUS = 1, SY_JOINT_PRISMATIC = 2 };

typedef struct sy_joint { /* record: of one coordinate; infinity where the file has no limit */
  uint32_t size;
  sy_joint_type type;
  const char* name;
  double position_lower;
  double position_upper;
  double velocity; /* |v| <= velocity */
  double effort;   /* |tau| <= effort */
  double armature; /* inertia of the rotor at the joint, part of inverse dynamics */
  double damping;  /* viscous: damping * v, part of inverse dynamics */
  double friction; /* dry; reported, and no part of inverse dynamics: it has no derivative at 0 */
} sy_joint;

typedef struct sy_model_facts { /* record: valid as long as the model */
  uint32_t size;
  int32_t num_positions;         /* n */
  const char* name;              /* of the model */
  const sy_joint* const* joints; /* n */
  const char* const* frames;     /* num_frames names: bodies, joints and frames of the file */
  int32_t num_frames;
  int32_t num_pairs; /* of geometries whose distance can be asked: not of one body, nor of a body
                      * and the one that carries it */
  const char* const* pair_first; /* num_pairs: names of geometries */
  const char* const* pair_second;
} sy_model_facts;

typedef struct sy_dynamics { /* record: "sy.dynamics/1" */
  uint32_t size;
  uint32_t reserved;
  const char* name; /* of the engine */
  const char* version;
  /* SY_E_RESOURCE: a file that cannot be read. SY_E_ARGUMENT: one that cannot be understood, with
   * its line where that is known, or a joint to lock that is not there. SY_E_UNSUPPORTED: a joint
   * that is none of the above. */
  sy_status (*load)(const sy_dynamics_source*, sy_dynamics_model**, sy_error*) SY_NOEXCEPT;
  void (*destroy)(sy_dynamics_model*) SY_NOEXCEPT;
  const sy_model_facts* (*facts)(const sy_dynamics_model*)SY_NOEXCEPT;
  /* tau = M(q) a + C(q, v) v + damping v - tau_g(q), n. d_q, d_v, d_a: n x n, the derivatives of
   * tau; each NULL where not wanted. */
  sy_status (*inverse_dynamics)(const sy_dynamics_model*, const double* q, const double* v,
                                const double* a, double* tau, double* d_q, double* d_v, double* d_a,
                                sy_error*) SY_NOEXCEPT;
  /* The Hessian of w'tau by (q, v, a): 3n x 3n, whole and symmetric. */
  sy_status (*inverse_dynamics_hessian)(const sy_dynamics_model*, const double* q, const double* v,
                                        const double* a, const double* w, double* hessian,
                                        sy_error*) SY_NOEXCEPT;
  /* The frame's origin (3), its axes (3 x 3, a rotation) and 6 x n the velocity of its origin, then
   * its angular velocity, both along the world's axes, by v; NULL where not wanted. */
  sy_status (*frame)(const sy_dynamics_model*, int32_t frame, const double* q, double* position,
                     double* rotation, double* jacobian, sy_error*) SY_NOEXCEPT;
  /* For each pair asked: the signed distance (negative where they meet, by the depth), and num x n,
   * row-major, its gradient by q; where distance and gradient are not differentiable, one of their
   * one-sided values. gradients NULL: not wanted. */
  sy_status (*distances)(const sy_dynamics_model*, const double* q, const int32_t* pairs,
                         int32_t num, double* distances, double* gradients, sy_error*) SY_NOEXCEPT;
} sy_dynamics;

#ifdef __cplusplus
}
#endif

#endif /* SY_DYNAMICS_H_ */
