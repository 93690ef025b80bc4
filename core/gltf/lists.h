#pragma once
/// The lists of a document that grow with the model, written as text: accessors, meshes, animations, views.
#include <string>
#include <vector>

#include "core/base/job.h"
#include "core/gltf/bin.h"
#include "core/gltf/columns.h"
#include "core/model/model.h"

namespace seedmesh::gltf {

/// Numbers of a list that leaves out what nobody uses, given in order of first use.
class Numbering {
 public:
  explicit Numbering(std::size_t size) : numbers_(size, -1) {}
  int use(int index);                                             ///< -1 stays -1
  const std::vector<int>& numbers() const { return numbers_; }    ///< for each index its number, or -1
  const std::vector<std::size_t>& used() const { return used_; }  ///< the indices, by number

 private:
  std::vector<int> numbers_;
  std::vector<std::size_t> used_;
};

/// The accessors of a document, and with them the contents of its buffer.
class Accessors {
 public:
  explicit Accessors(Packing packing) : packing_(packing) {}
  Packing packing() const { return packing_; }

  /// Stores the column in the buffer and returns the number of its accessor. `column` has to stay.
  int add(Pool pool, const Column& column);

  Bin& bin() { return bin_; }
  bool empty() const { return rows_.empty(); }

  /// Appends the JSON array; the buffer has been arranged.
  void append(std::string& out, Job& job) const;

 private:
  struct Row {
    int item = -1;
    const Column* column = nullptr;
  };
  Packing packing_;
  std::vector<Row> rows_;
  Bin bin_;
};

/// Materials that primitives use; `any_variants` is set where one of them depends on the variant.
struct MaterialUse {
  Numbering numbering;
  bool any_variants = false;
};

/// Appends one mesh object. Each column becomes an accessor; numbers the materials.
void append_mesh(std::string& out, const std::string& name, const std::vector<Part>& parts,
                 Accessors& accessors, MaterialUse& materials);

/// Appends one animation object; samplers with the same key times share the accessor.
void append_animation(std::string& out, const Animation& animation, const Tracks& tracks,
                      Accessors& accessors);

/// Appends the views of a buffer that has been arranged: a JSON array without the closing bracket, or
/// nothing.
void append_views(std::string& out, const Bin& bin);

}  // namespace seedmesh::gltf
