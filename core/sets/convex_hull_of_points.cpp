// The one place that knows Qhull (Barber, Dobkin, Huhdanpaa: The Quickhull Algorithm for Convex
// Hulls, ACM Transactions on Mathematical Software 22, 1996), by its reentrant library.
#include "core/sets/convex_hull_of_points.hpp"

extern "C" {
#include <libqhull_r/qhull_ra.h>
}

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <string>

#include "switchyard/error.hpp"

namespace switchyard {
namespace {

/// What Qhull has to say goes to a text instead of a stream.
class Words {
 public:
  Words() : file_(open_memstream(&text_, &size_)) {}
  Words(const Words&) = delete;
  Words& operator=(const Words&) = delete;
  ~Words() {
    std::fclose(file_);
    std::free(text_);
  }
  [[nodiscard]] FILE* file() const { return file_; }
  [[nodiscard]] std::string FirstLine() const {
    std::fflush(file_);
    const std::string all(text_ != nullptr ? text_ : "");
    return all.substr(0, all.find('\n'));
  }

 private:
  char* text_ = nullptr;
  std::size_t size_ = 0;
  FILE* file_;
};

class Qhull {
 public:
  // Coordinates are points x n, row after row: the columns of a matrix as they stand.
  explicit Qhull(const Eigen::MatrixXd& points) : points_(points) {
    qh_zero(&qh_, words_.file());
    std::string command = "qhull FA Pp";  // the volume as well; no warning of a narrow hull
    const int failed =
        qh_new_qhull(&qh_, static_cast<int>(points.rows()), static_cast<int>(points.cols()),
                     points_.data(), False, command.data(), nullptr, words_.file());
    if (failed == 0) return;
    const std::string why = words_.FirstLine();
    Free();
    Refuse("the hull of ", points.cols(), " points in R^", points.rows(),
           " needs them to span it: ", why);
  }
  Qhull(const Qhull&) = delete;
  Qhull& operator=(const Qhull&) = delete;
  ~Qhull() { Free(); }

  HullOfPoints Read() {
    HullOfPoints hull;
    hull.volume = qh_.totvol;
    hull.normals.resize(qh_.num_facets, points_.rows());
    Eigen::Index row = 0;
    for (const facetT* facet = qh_.facet_list; facet != nullptr && facet->next != nullptr;
         facet = facet->next) {
      hull.normals.row(row++) = Eigen::VectorXd::Map(facet->normal, points_.rows());
    }
    hull.normals.conservativeResize(row, points_.rows());
    for (vertexT* vertex = qh_.vertex_list; vertex != nullptr && vertex->next != nullptr;
         vertex = vertex->next) {
      hull.extreme.push_back(qh_pointid(&qh_, vertex->point));
    }
    std::sort(hull.extreme.begin(), hull.extreme.end());
    return hull;
  }

 private:
  void Free() {
    qh_freeqhull(&qh_, qh_ALL);
    int current = 0;
    int total = 0;
    qh_memfreeshort(&qh_, &current, &total);
  }

  Eigen::MatrixXd points_;  // Qhull keeps pointers into it
  Words words_;
  qhT qh_;
};

HullOfPoints HullOnTheLine(const Eigen::MatrixXd& points) {
  Eigen::Index least = 0;
  Eigen::Index most = 0;
  HullOfPoints hull;
  hull.volume = -points.row(0).minCoeff(&least) + points.row(0).maxCoeff(&most);
  hull.normals = Eigen::Vector2d(-1, 1);
  hull.extreme = {static_cast<int>(std::min(least, most)), static_cast<int>(std::max(least, most))};
  return hull;
}

}  // namespace

// A facet of Qhull may be merged from several, and lie within some points by rounding: it is moved
// out to the last of them.
HullOfPoints ConvexHullOfPoints(const Eigen::MatrixXd& points) {
  HullOfPoints hull = points.rows() == 1 ? HullOnTheLine(points) : Qhull(points).Read();
  hull.offsets = (hull.normals * points).rowwise().maxCoeff();
  return hull;
}

}  // namespace switchyard
