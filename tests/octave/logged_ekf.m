% SPDX-License-Identifier: MIT
% A small EKF-SLAM for Octave or MATLAB that logs itself with apps/loggers/slamscope_log.m
% (run.jsonl) and saves what people save: cells.mat, stack.mat, struct.mat, diagonal.mat.
% Called in the folder to write to, with the loggers' folder on the path.
% Optional variable `late`: true takes the motion Jacobian at the heading after the move.
if ~exist('late', 'var')
  late = false;
end
randn('state', 1);
map = [0.9 -0.1; 1.4 0.6; 1.2 1.8; -0.4 2.3; -1.3 1.2]';  % true, m
names = [1 2 3 4 7];
dt = 0.1; v = 0.25; w = 0.25;
M = diag([0.05 0.1].^2);
R = diag([0.05 0.03].^2);
wrap = @(a) mod(a + pi, 2 * pi) - pi;
steps = 150;
truth = zeros(3, 1); x = zeros(3, 1); P = zeros(3); ids = [];
record = slamscope_log('run.jsonl', 'range-bearing', R);
xs = cell(1, steps + 10); Ps = cell(1, steps + 10);   % more than is used
full_x = NaN(13, steps); full_P = NaN(13, 13, steps); t = zeros(1, steps);
data = struct('i', 1, 'path', x, 'true', x);
data.state(1).x = x; data.state(1).P = P;
small = struct('i', 1, 'path', x, 'true', x);
small.state(1).x = x; small.state(1).P = diag(P);
for k = 1:steps
  u = [v; w] + sqrt(diag(M)) .* randn(2, 1);
  truth = truth + dt * [u(1) * cos(truth(3)); u(1) * sin(truth(3)); u(2)];
  F = eye(numel(x));
  heading = x(3) + late * w * dt;
  F(1, 3) = -v * dt * sin(heading); F(2, 3) = v * dt * cos(heading);
  G = zeros(numel(x), 2);
  G(1:3, :) = dt * [cos(x(3)) 0; sin(x(3)) 0; 0 1];
  x(1:3) = x(1:3) + dt * [v * cos(x(3)); v * sin(x(3)); w];
  P = F * P * F' + G * M * G';
  t(k) = k * dt;
  record.predicted(x, P, t(k));
  for n = 1:numel(names)
    d = map(:, n) - truth(1:2);
    z = [norm(d); atan2(d(2), d(1)) - truth(3)] + sqrt(diag(R)) .* randn(2, 1);
    z(2) = wrap(z(2));
    if z(1) > 1.5 || abs(z(2)) > 1
      continue
    end
    at = find(ids == names(n));
    if isempty(at)
      a = x(3) + z(2);
      Gx = [1 0 -z(1) * sin(a); 0 1 z(1) * cos(a)];
      Gz = [cos(a) -z(1) * sin(a); sin(a) z(1) * cos(a)];
      cross = Gx * P(1:3, :);
      P = [P cross'; cross Gx * P(1:3, 1:3) * Gx' + Gz * R * Gz'];
      x = [x; x(1:2) + z(1) * [cos(a); sin(a)]];
      ids(end + 1) = names(n);
      record.initialised(x, P, names(n));
    else
      j = 2 + 2 * at;
      e = x(j:j + 1) - x(1:2); q = e' * e; r = sqrt(q);
      H = zeros(2, numel(x));
      H(:, 1:3) = [-e' / r 0; e(2) / q -e(1) / q -1];
      H(:, j:j + 1) = [e' / r; -e(2) / q e(1) / q];
      nu = z - [r; wrap(atan2(e(2), e(1)) - x(3))]; nu(2) = wrap(nu(2));
      K = P * H' / (H * P * H' + R);
      x = x + K * nu;
      P = P - K * H * P; P = (P + P') / 2;
      record.updated(x, P, names(n));
    end
  end
  xs{k} = x; Ps{k} = P;
  full_x(1:numel(x), k) = x; full_P(1:numel(x), 1:numel(x), k) = P;
  data.i = k + 1; data.path(:, k + 1) = x(1:3); data.true(:, k + 1) = truth;
  data.state(k + 1).x = x; data.state(k + 1).P = P;
  small.i = k + 1; small.path(:, k + 1) = x(1:3); small.true(:, k + 1) = truth;
  small.state(k + 1).x = x; small.state(k + 1).P = diag(P);
end
record.close();
saved = struct('t', t); saved.x = xs; saved.P = Ps;
save('-v7', 'cells.mat', '-struct', 'saved');
saved = struct('t', t, 'x', full_x, 'P', full_P);
save('-v6', 'stack.mat', '-struct', 'saved');
save('-v7', 'struct.mat', 'data');
data = small;
save('-v7', 'diagonal.mat', 'data');
