% SPDX-License-Identifier: MIT
%
% Logs an EKF-SLAM filter for slamscope: one file, for MATLAB and Octave, three calls (level L2).
%
%   record = slamscope_log('run.jsonl', 'range-bearing', R);
%   while driving
%     [x, P] = predict(x, P, u);
%     record.predicted(x, P, t);               % after every prediction; t in seconds
%     for k = 1:numel(ids)
%       if ismember(ids(k), known)
%         [x, P] = update(x, P, z(:, k), ids(k));
%         record.updated(x, P, ids(k));        % after every update: the ids observed in it
%       else
%         [x, P] = initialise(x, P, z(:, k));
%         record.initialised(x, P, ids(k));    % after every new feature: its id
%       end
%     end
%   end
%
% Then: slamscope audit run.jsonl
%
% x is the state [x; y; heading; l1x; l1y; l2x; l2y; ...] in m and rad, P its full covariance.
% Without t, predictions are counted; without ids, features are called 1, 2, ... by their place in
% the state. Where features leave the state: record.removed(x, P, ids). The sensor is
% 'range-bearing', 'relative-position' or 'unknown'; R (2 x 2) and Q (3 x 3: of the pose, a step),
% where constant, let the audit compare them with what the filter did.
classdef slamscope_log < handle
  properties (Access = private)
    file = -1;
    time = 0;
    ids = [];
    named = false;
  end

  methods
    function self = slamscope_log(name, sensor, R, Q)
      [self.file, message] = fopen(name, 'w');
      if self.file < 0
        error('slamscope_log: %s: %s', name, message);
      end
      if nargin < 2
        sensor = 'unknown';
      end
      header = sprintf('{"format": "slamscope", "version": 1, "sensor": "%s"', sensor);
      if nargin > 2 && ~isempty(R)
        header = [header ', "R": ' slamscope_log.list(R.')];
      end
      if nargin > 3 && ~isempty(Q)
        header = [header ', "Q": ' slamscope_log.list(Q.')];
      end
      self.put([header '}']);
    end

    function predicted(self, x, P, t)
      if nargin < 4
        t = self.time + 1;
      end
      self.time = t;
      self.record('predict', x, P, '');
    end

    function updated(self, x, P, observed)
      more = '';
      if nargin > 3
        more = [', "observed": ' slamscope_log.whole(observed)];
      end
      self.record('update', x, P, more);
    end

    function initialised(self, x, P, new_ids)
      if nargin > 3
        self.named = true;
        self.ids = [self.ids, reshape(double(new_ids), 1, [])];
      end
      self.record('initialise', x, P, '');
    end

    function removed(self, x, P, old_ids)
      self.named = true;
      self.ids = self.ids(~ismember(self.ids, double(old_ids)));
      self.record('remove', x, P, '');
    end

    function close(self)
      if self.file >= 0
        fclose(self.file);
      end
      self.file = -1;
    end
  end

  methods (Access = private)
    function record(self, event, x, P, more)
      n = (numel(x) - 3) / 2;
      if ~self.named
        self.ids = 1:n;
      end
      if numel(self.ids) ~= n
        error('slamscope_log: x has %d numbers, expected %d for the %d features whose ids are known', ...
              numel(x), 3 + 2 * numel(self.ids), numel(self.ids));
      end
      if numel(P) ~= numel(x)^2
        error('slamscope_log: P has %d numbers, x has %d', numel(P), numel(x));
      end
      x = full(double(x(:)));
      self.put([sprintf('{"time_s": %.17g, "event": "%s"', self.time, event), ...
                ', "pose": ' slamscope_log.list(x(1:3)), ...
                ', "ids": ' slamscope_log.whole(self.ids), ...
                ', "features": ' slamscope_log.list(x(4:end)), ...
                ', "covariance": ' slamscope_log.list(full(double(P)).'), more '}']);
    end

    function put(self, line)
      fprintf(self.file, '%s\n', line);
      if exist('OCTAVE_VERSION', 'builtin')  % MATLAB writes at once
        fflush(self.file);
      end
    end
  end

  methods (Static, Access = private)
    function text = list(values)
      text = sprintf('%.17g, ', values);
      text = ['[' strrep(text(1:end - 2), 'Inf', 'Infinity') ']'];
    end

    function text = whole(values)
      text = sprintf('%.0f, ', double(values));
      text = ['[' text(1:end - 2) ']'];
    end
  end
end
