// muelu_client [points]: Poisson's equation by conjugate gradients, preconditioned by MueLu, whose
// coarse levels are repartitioned by partitioner=zoltan; no word of RRCB.
#include "poisson.hpp"
#include "result.hpp"

#include <MueLu_CreateTpetraPreconditioner.hpp>
#include <MueLu_TpetraOperator.hpp>
#include <Tpetra_Core.hpp>
#include <Tpetra_CrsMatrix.hpp>

namespace {

using Map = Tpetra::Map<>;
using Matrix = Tpetra::CrsMatrix<double>;
using Operator = Tpetra::Operator<double>;
using Vector = Tpetra::Vector<double>;
using Vectors = Tpetra::MultiVector<double>;
using Global = Map::global_ordinal_type;
using MueluOperator = MueLu::TpetraOperator<double, Map::local_ordinal_type, Global>;
using Teuchos::RCP;
using Teuchos::rcp;

RCP<Matrix> matrix_of(const Poisson& problem, const RCP<const Map>& map) {
    RCP<Matrix> matrix = rcp(new Matrix(map, 7));
    for (int i = 0; i < problem.num_rows(); ++i) {
        const std::vector<int> columns = problem.columns_of(problem.row(i));
        const std::vector<Global> ids(columns.begin(), columns.end());
        std::vector<double> values(columns.size(), -1);
        values[0] = 6;
        matrix->insertGlobalValues(problem.row(i), Teuchos::arrayViewFromVector(ids),
                                   Teuchos::arrayViewFromVector(values));
    }
    matrix->fillComplete();
    return matrix;
}

Teuchos::ParameterList parameters_with(const Poisson& problem, const RCP<const Map>& map) {
    const RCP<Vectors> coordinates = rcp(new Vectors(map, 3));
    for (int axis = 0; axis < 3; ++axis) {
        for (int i = 0; i < problem.num_rows(); ++i) {
            coordinates->replaceLocalValue(i, static_cast<std::size_t>(axis),
                                           problem.coordinate(problem.row(i), axis));
        }
    }
    Teuchos::ParameterList list;
    list.set("verbosity", "none");
    list.set("coarse: max size", 20);
    list.set("repartition: enable", true);
    list.set("repartition: partitioner", "zoltan");
    list.set("repartition: start level", 1);
    list.set("repartition: min rows per proc", 20);
    list.set("repartition: max imbalance", 1.1);
    list.sublist("user data").set("Coordinates", coordinates);
    return list;
}

/// Conjugate gradients to 1e-10 of the right-hand side; returns the iterations, 101 where more are
/// needed.
int solve(const Operator& matrix, const Operator& preconditioner, const Vector& right, Vector& x) {
    const RCP<const Map> map = right.getMap();
    Vector residual(right, Teuchos::Copy), z(map), direction(map), image(map);
    const double enough = 1e-10 * right.norm2();
    double product = 1;
    for (int iteration = 0; iteration <= 100; ++iteration) {
        if (residual.norm2() <= enough) return iteration;
        preconditioner.apply(residual, z);
        const double next = residual.dot(z);
        direction.update(1, z, iteration == 0 ? 0 : next / product);
        product = next;
        matrix.apply(direction, image);
        const double step = product / direction.dot(image);
        x.update(step, direction, 1);
        residual.update(-step, image, 1);
    }
    return 101;
}

/// Of the first coarse level, which is what RCB divides first.
double coarse_imbalance(const MueluOperator& preconditioner) {
    const auto level = preconditioner.GetHierarchy()->GetLevel(1);
    using Coarse = Xpetra::Matrix<double, Map::local_ordinal_type, Global>;
    const auto matrix = level->Get<RCP<Coarse>>("A");
    return imbalance_of(matrix.is_null() ? 0 : static_cast<int>(matrix->getNodeNumRows()));
}

int run(int points) {
    const auto comm = Tpetra::getDefaultComm();
    const Poisson problem(points, comm->getRank(), comm->getSize());
    const RCP<const Map> map = rcp(new Map(Teuchos::OrdinalTraits<Tpetra::global_size_t>::invalid(),
                                           static_cast<std::size_t>(problem.num_rows()), 0, comm));
    const RCP<Matrix> matrix = matrix_of(problem, map);
    Teuchos::ParameterList list = parameters_with(problem, map);
    const auto preconditioner = MueLu::CreateTpetraPreconditioner(RCP<Operator>(matrix), list);
    Vector solution(map), right(map);
    right.putScalar(1);
    const int iterations = solve(*matrix, *preconditioner, right, solution);
    const double largest = solution.normInf();
    print_result(static_cast<int>(map->getGlobalNumElements()), coarse_imbalance(*preconditioner),
                 {largest, solution.norm2()});
    if (comm->getRank() == 0) std::printf("%d iterations\n", iterations);
    return iterations <= 100 && problem.is_solved(largest) ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
    const Tpetra::ScopeGuard guard(&argc, &argv);
    return run(argc > 1 ? std::atoi(argv[1]) : 15);
}
