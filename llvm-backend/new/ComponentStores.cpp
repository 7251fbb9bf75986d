#include "ComponentStores.h"
#include "llvm/Analysis/ValueTracking.h"
#include "llvm/IR/IRBuilder.h"
#include "llvm/IR/InstIterator.h"
#include "llvm/IR/Instructions.h"
#include "llvm/IR/Module.h"
#include "llvm/Transforms/Utils/Local.h"
#include <optional>

using namespace llvm;

namespace {

/// Where a lane of a vector comes from.
struct Source {
  Value *From;   ///< a vector, a scalar, or null for any value (poison)
  unsigned Lane; ///< of the vector
};

unsigned lanesOf(const Value *Vector) {
  return cast<FixedVectorType>(Vector->getType())->getNumElements();
}

/// Of lane \p Lane of \p Vector, through insertions and shuffles down to
/// \p Loaded. None where the place of an insertion is not known.
std::optional<Source> sourceOf(Value *Vector, unsigned Lane,
                               const LoadInst *Loaded) {
  while (Vector != Loaded) {
    if (auto *Insertion = dyn_cast<InsertElementInst>(Vector)) {
      const auto *Place = dyn_cast<ConstantInt>(Insertion->getOperand(2));
      if (!Place)
        return std::nullopt;
      if (Place->equalsInt(Lane))
        return Source{Insertion->getOperand(1), 0};
      Vector = Insertion->getOperand(0);
      continue;
    }
    auto *Shuffle = dyn_cast<ShuffleVectorInst>(Vector);
    if (!Shuffle || !isa<FixedVectorType>(Shuffle->getOperand(0)->getType()))
      break;
    const int Place = Shuffle->getMaskValue(Lane);
    if (Place < 0)
      return Source{nullptr, 0};
    const unsigned Lanes = lanesOf(Shuffle->getOperand(0));
    const auto From = static_cast<unsigned>(Place);
    Vector = Shuffle->getOperand(From < Lanes ? 0 : 1);
    Lane = From % Lanes;
  }
  return Source{Vector, Lane};
}

/// The load of the same vector that \p Value changes in some lanes.
LoadInst *loadBehind(Value *Vector, const StoreInst &Store) {
  if (auto *Load = dyn_cast<LoadInst>(Vector))
    return Load->getPointerOperand() == Store.getPointerOperand() &&
                   Load->getType() == Store.getValueOperand()->getType() &&
                   Load->getParent() == Store.getParent() && !Load->isAtomic()
               ? Load
               : nullptr;
  if (auto *Insertion = dyn_cast<InsertElementInst>(Vector))
    return loadBehind(Insertion->getOperand(0), Store);
  if (auto *Shuffle = dyn_cast<ShuffleVectorInst>(Vector)) {
    LoadInst *First = loadBehind(Shuffle->getOperand(0), Store);
    return First ? First : loadBehind(Shuffle->getOperand(1), Store);
  }
  return nullptr;
}

bool isWrittenBetween(const LoadInst &Load, const StoreInst &Store) {
  for (const Instruction *I = Load.getNextNode(); I != &Store;
       I = I->getNextNode())
    if (!I || I->mayWriteToMemory())
      return true;
  return false;
}

/// Stores parts of what \p Whole stores.
class PartStores {
public:
  explicit PartStores(StoreInst &Whole)
      : Whole(Whole), Builder(&Whole),
        Element(cast<VectorType>(Whole.getValueOperand()->getType())
                    ->getElementType()),
        Bytes(Whole.getDataLayout().getTypeStoreSize(Element)) {}

  void lane(unsigned Lane, Source What) {
    Value *Part = What.From->getType() == Element
                      ? What.From
                      : Builder.CreateExtractElement(What.From, What.Lane);
    at(ConstantInt::get(Builder.getInt32Ty(), Lane), Part,
       commonAlignment(Whole.getAlign(), Lane * Bytes));
  }
  void at(Value *Place, Value *Part) {
    at(Place, Part, commonAlignment(Whole.getAlign(), Bytes));
  }

private:
  void at(Value *Place, Value *Part, Align Alignment) {
    Value *Address =
        Builder.CreateInBoundsGEP(Element, Whole.getPointerOperand(), Place);
    Builder.CreateAlignedStore(Part, Address, Alignment, Whole.isVolatile());
  }

  StoreInst &Whole;
  IRBuilder<> Builder;
  Type *Element;
  uint64_t Bytes;
};

/// Whether there is an address for each lane.
bool hasAddresses(const FixedVectorType *T, const DataLayout &Layout) {
  Type *Element = T->getElementType();
  return Layout.getTypeSizeInBits(Element) ==
         8 * Layout.getTypeAllocSize(Element);
}

/// False if all of \p Store has to be stored.
bool storeParts(StoreInst &Store) {
  Value *const Stored = Store.getValueOperand();
  const auto *T = dyn_cast<FixedVectorType>(Stored->getType());
  if (!T || Store.isAtomic() || !hasAddresses(T, Store.getDataLayout()) ||
      isa<AllocaInst>(getUnderlyingObject(Store.getPointerOperand())))
    return false;
  const LoadInst *const Load = loadBehind(Stored, Store);
  if (!Load || Load == Stored || isWrittenBetween(*Load, Store))
    return false;
  PartStores Parts(Store);
  auto *const Insertion = dyn_cast<InsertElementInst>(Stored);
  if (Insertion && Insertion->getOperand(0) == Load &&
      !isa<ConstantInt>(Insertion->getOperand(2))) {
    Parts.at(Insertion->getOperand(2), Insertion->getOperand(1));
    return true;
  }
  SmallVector<std::pair<unsigned, Source>, 16> Changed;
  for (unsigned Lane = 0; Lane != T->getNumElements(); ++Lane) {
    const std::optional<Source> What = sourceOf(Stored, Lane, Load);
    if (!What)
      return false;
    if (What->From && (What->From != Load || What->Lane != Lane))
      Changed.emplace_back(Lane, *What);
  }
  if (Changed.size() == T->getNumElements())
    return false;
  for (const auto &[Lane, What] : Changed)
    Parts.lane(Lane, What);
  return true;
}

} // namespace

void vorion::storeComponents(Module &M) {
  for (Function &F : M)
    for (Instruction &I : make_early_inc_range(instructions(F)))
      if (auto *Store = dyn_cast<StoreInst>(&I))
        if (storeParts(*Store)) {
          Value *const Stored = Store->getValueOperand();
          Store->eraseFromParent();
          RecursivelyDeleteTriviallyDeadInstructions(Stored);
        }
}
