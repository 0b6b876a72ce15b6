# Окно.
app-name = Sinew
app-title-more = { $file } и ещё { $count }
app-about = Клипы скелетной анимации и мышцы постоянного объёма в одной сцене. Видеокарта не нужна.
app-no-display = Нет дисплея, на котором можно открыть окно. Изображение можно получить и без него: sinew render ФАЙЛ -o image.png
app-no-fonts = Не установлено ни одного шрифта, и окно не может показать текст: установите какой-нибудь шрифт, например DejaVu (в Debian – пакет fonts-dejavu-core).
app-open = Открыть
app-cancel = Отмена
app-save = Сохранить
app-retry = Повторить
app-details = Подробности
app-bar-close = Закрыть эту полосу
app-copied = Скопировано.
app-warning = Предупреждение
app-note = Примечание
app-line = строка { $line }
app-at-line = Строка { $line }
app-at-line-column = Строка { $line }, столбец { $column }
app-unit-mm = мм
app-unit-cm = см
app-unit-m = м
app-unit-s = с
app-unit-cm3 = см³
app-unit-m3 = м³

# Страницы и группы
app-page-muscle = Мышца
app-page-display = Отображение
app-page-diagnostics = Диагностика
app-group-files = Файлы
app-group-pictures = Изображения и экспорт
app-group-playback = Воспроизведение
app-group-time = Время
app-group-camera = Камера и свет
app-group-model = Модель
app-group-display = Отображение
app-group-inspection = Выделенное
app-group-window = Окно
app-group-mouse = Мышь
app-menu-camera = Ракурс
app-menu-display = Отображение
app-menu-colours = Тема оформления
app-file-cameras = Камеры из файла

# Команды
app-do-open = Открыть файлы
app-do-compare-file = Сравнить с файлом…
app-do-reload = Перезагрузить
app-do-previous-file = Предыдущий файл в папке
app-do-next-file = Следующий файл в папке
app-do-picture = Сохранить изображение
app-do-picture-transparent = Сохранить изображение без фона
app-do-copy-picture = Скопировать изображение
app-do-close = Закрыть
app-do-quit = Выйти
app-do-play = Воспроизведение или пауза
app-do-reverse = Воспроизвести в обратную сторону
app-do-frame-back = На кадр назад
app-do-frame-forward = На кадр вперёд
app-do-second-back = На секунду назад
app-do-second-forward = На секунду вперёд
app-do-first = В начало
app-do-last = В конец
app-do-previous-key = Предыдущий ключевой кадр
app-do-next-key = Следующий ключевой кадр
app-do-slower = Медленнее
app-do-faster = Быстрее
app-do-normal-speed = Обычная скорость
app-do-loop-mode = Режим повтора
app-do-mark-a = Поставить метку A
app-do-mark-b = Поставить метку B
app-do-clear-marks = Убрать метки A и B
app-do-timeline-zoom-in = Увеличить масштаб шкалы времени
app-do-timeline-zoom-out = Уменьшить масштаб шкалы времени
app-do-timeline-zoom-all = Показать шкалу времени целиком
app-do-sheet = Ключевые кадры по костям
app-do-curves = Кривые анимации
app-do-previous-clip = Предыдущий клип
app-do-next-clip = Следующий клип
app-do-fit = Показать всё
app-do-reset-camera = Сбросить камеру
app-do-centre = Центрировать на выделенном
app-do-view-front = Спереди
app-do-view-back = Сзади
app-do-view-right = Справа
app-do-view-left = Слева
app-do-view-top = Сверху
app-do-view-bottom = Снизу
app-do-view-iso = Изометрия
app-do-view-iso-opposite = Изометрия сзади
app-do-orthographic = Ортогональная проекция
app-do-fly = Полёт
app-do-follow = Следовать за выделенным
app-do-smooth-camera = Плавный переход камеры
app-do-reset-light = Сбросить положение света
app-do-tool-navigate = Навигация: мышь управляет камерой
app-do-tool-move = Переместить модель
app-do-tool-rotate = Повернуть модель
app-do-tool-scale = Масштабировать модель
app-do-reset-model = Сбросить преобразование модели
app-do-contract-more = Сократить на 5 %
app-do-contract-less = Расслабить на 5 %
app-do-elbow-more = Согнуть локоть на 5°
app-do-elbow-less = Разогнуть локоть на 5°
app-do-undo = Отменить
app-do-redo = Повторить
app-step = { $what }: { $step } ({ $key })
app-edit-move = перенос модели
app-edit-rotate = поворот модели
app-edit-scale = масштаб модели
app-edit-reset-model = сброс преобразования модели
app-edit-light = перенос источника света
app-edit-visible = изменение видимости
app-edit-isolate = только выделенное
app-edit-rotate-joint = поворот сустава
app-edit-reset-rotations = сброс поворотов, заданных вручную
app-edit-bend = сгибание сустава
app-edit-contract = сокращение мышцы
app-edit-release = возврат сустава клипу
app-edit-joint = выбор сустава
app-edit-on-top = сгибание поверх клипа
app-do-bones = Кости
app-do-bone-names = Имена костей
app-do-bone-axes = Оси костей
app-do-xray = Кости поверх поверхностей
app-do-mesh = Полигональные сетки
app-do-muscle = Мышцы
app-do-see-through = Мышцы сквозь кожу
app-do-skin-follows-muscles = Кожа следует за мышцами
app-do-lines-of-action = Линии действия
app-do-materials = Материалы и текстуры
app-do-smooth-normals = Сглаженные нормали
app-do-normal-glyphs = Показать нормали
app-do-wireframe = Каркасный вид
app-do-weights = Веса вершин для выделенной кости
app-do-onion-skins = Калька (соседние кадры)
app-do-bone-path = Траектория выделенного
app-do-compare-skinning = Сравнить методы скиннинга
app-do-stop-comparing = Закончить сравнение
app-do-isolate = Только выделенное
app-do-hide = Скрыть выделенное
app-do-show-all = Показать всё
app-do-grid = Координатная сетка
app-do-axes = Мировые оси
app-do-bounding-box = Ограничивающий параллелепипед
app-do-depth-test = Тест глубины (z-буфер)
app-do-cull-back-faces = Отсечение нелицевых граней
app-do-anti-aliasing = Сглаживание (4 отсчёта)
app-do-preset-clean = Предустановка «Без разметки»
app-do-preset-skeleton = Предустановка «Скелет»
app-do-preset-inspection = Предустановка «Разбор»
app-do-preset-print = Предустановка «Для печати»
app-do-flat = Плоская
app-do-gouraud = По Гуро
app-do-phong = По Фонгу
app-do-sidebars = Обе боковые панели
app-do-tree = Дерево сцены
app-do-panel = Правая панель
app-do-fullscreen = Во весь экран
app-do-frame-times = Время кадра
app-do-colours-system = Как в системе
app-do-colours-light = Светлая
app-do-colours-dark = Тёмная
app-do-menu = Главное меню
app-do-help = Справка
app-do-shortcuts = Сочетания клавиш
app-do-about = О программе

# Мышь
app-mouse-orbit = Вращение камеры
app-mouse-orbit-how = Левая или средняя кнопка
app-mouse-pan = Сдвиг камеры
app-mouse-pan-how = Shift и левая кнопка
app-mouse-zoom = Масштаб
app-mouse-zoom-how = Колесо, щипок или Ctrl и левая кнопка
app-mouse-zoom-pointer = Масштаб относительно указателя
app-mouse-zoom-pointer-how = Ctrl и колесо
app-mouse-light = Положение света
app-mouse-light-how = Правая кнопка; Shift и щелчок правой кнопкой – сброс
app-mouse-pick = Выделение
app-mouse-pick-how = Щелчок
app-mouse-centre = Центрирование
app-mouse-centre-how = Двойной щелчок
app-mouse-fly = В полёте
app-mouse-fly-how = W A S D Q E; Shift – быстрее, Alt – медленнее; колесо – скорость; Esc – конец полёта
app-mouse-time = На шкале времени
app-mouse-time-how = Shift и мышь – метки A и B; колесо – по кадрам; Ctrl и колесо – масштаб; Shift и колесо – прокрутка

# Область просмотра
app-nothing-drawn = В этом файле нет ничего, что можно нарисовать, – см. «Диагностика».
app-viewport = Область просмотра
app-hint = Мышь вращает · Shift сдвигает · колесо –⁠ масштаб · правая кнопка –⁠ свет
app-hint-move = Тяните ось, квадрат или любое место · Ctrl –⁠ с шагом · средняя кнопка вращает камеру · V –⁠ конец
app-hint-rotate = Тяните кольцо или любое место · Ctrl –⁠ с шагом 15° · средняя кнопка вращает камеру · V –⁠ конец
app-hint-scale = Тяните кубик или любое место вверх · Ctrl –⁠ с шагом · средняя кнопка вращает камеру · V –⁠ конец
app-hint-fly = W A S D и Q E –⁠ полёт · мышь –⁠ направление взгляда · колесо –⁠ { $speed } м/с · Esc –⁠ конец
app-times = { $rate } кадр/с · { $total } мс
    поза { $pose } · вершины { $vertex }
    растеризация { $raster } · сведение отсчётов { $resolve }
app-axis-x = X
app-axis-y = Y
app-axis-z = Z
app-numbers-move = Перенос, м
app-numbers-rotate = Поворот, °
app-numbers-scale = Масштаб
app-drop-here = Отпустите, чтобы открыть
app-open-folder = Открыть папку
app-folder-failed = Не удалось открыть папку: { $reason }
app-weights-of = Веса вершин: { $name }
app-status-memory = { $size } МБ
app-status-position = { $name }: x { $x }; y { $y }; z { $z } м
app-status-triangles = { $count ->
    [one] { $shown } треугольник
    [few] { $shown } треугольника
   *[other] { $shown } треугольников
}
app-picture-title = Сохранить изображение
app-picture-copied = Изображение скопировано.
app-saved = Сохранено: { $file }.
app-unsaved = Не удалось сохранить { $file }

# Файлы
app-loading = Чтение: { $file } …
app-loading-progress = Чтение
app-refused = Не удалось открыть { $file }
app-kept = Открытые ранее файлы остались открытыми.
app-reader-broke = Чтение файла прервано из-за внутренней ошибки. Пожалуйста, сообщите об ошибке и приложите файл.
app-reloaded = Перезагружено: изменений нет.
app-reloaded-changes = Перезагружено: { $changes }.
app-compared-lost = Не удалось открыть файл { $file }, с которым сравнивает сеанс.
app-compared-again = { $file }: { $news }
app-changed-gone = удалено: { $names }
app-changed-new = добавлено: { $names }
app-changed-clips-gone = удалены клипы: { $names }
app-changed-clips-new = добавлены клипы: { $names }
app-changed-more = { $names } и ещё { $count }
app-changed-triangles = треугольники: { $old } → { $new }
app-changed-seconds = длительность: { $old } → { $new } с
app-changed-findings = замечания: { $old } → { $new }
app-changed-shapes = { $count ->
    [one] изменились вершины { $count } сетки
   *[other] изменились вершины { $count } сеток
}
app-changed-curves = { $count ->
    [one] изменились ключевые кадры { $count } канала
   *[other] изменились ключевые кадры { $count } каналов
}
app-diagnostics-found = { $count ->
    [one] При чтении найдена { $count } проблема – см. «Диагностика».
    [few] При чтении найдены { $count } проблемы – см. «Диагностика».
   *[other] При чтении найдено { $count } проблем – см. «Диагностика».
}
app-choose-compared = Сравнить с файлом
app-choose-title = Открыть файлы
app-choose-open = Открыть
app-choose-ours = Клипы и мышцы
app-choose-all = Все файлы
app-recent = Недавние файлы
app-recent-none = Пока нет
app-settings-broken = Не удалось прочитать настройки в { $file }, они не учтены: { $reason }
app-settings-unsaved = Не удалось сохранить настройки: { $reason }
app-missing = нет: { $what }
app-missing-still = нет: { $what } (статичная сцена)
app-missing-mesh = полигональная сетка
app-missing-skeleton = скелет
app-missing-animation = анимация

# Начальная страница
app-start-title = Нет открытых файлов
app-start-text = Откройте клип COLLADA (.dae, .zae) или мышцу (.yaml) либо перетащите файлы сюда.
app-start-open = Открыть файлы
app-start-more = Открыть другой файл
app-start-back = Назад к сцене
app-start-demos = Примеры
app-demo-biceps = Бицепс по измеренным радиусам
app-demo-curl = Бицепс и трицепс: сгибание в локте
app-demo-atlas = Мышцы в прозрачной руке
app-demo-walker = Шагающий робот
app-demo-lamp = Качающаяся лампа
app-demo-unwritten = Не удалось записать примеры в { $folder }
app-do-save-session = Сохранить сеанс как…
app-do-start-page = Начальная страница
app-session-title = Сохранить сеанс
app-session-saved = Сеанс сохранён в { $file }

# Шкала времени
app-play = Воспроизвести
app-time = Время
app-time-tip = Время в секундах
app-clip = Клип
app-speed = Скорость; отрицательная – обратное воспроизведение
app-seconds = Время
app-seconds-tip = Точное время в секундах
app-frame = Кадр
app-frame-tip = Номер кадра
app-no-animation = Анимации нет
app-loop = повтор
app-once = один раз
app-ping-pong = туда и обратно
app-loop-tip = В конце: { $mode } ({ $key })
app-rate = { $rate } кадр/с
app-rate-own = Авто: { $rate } кадр/с
app-rate-tip = Частота кадров, по которой считаются номера кадров
app-sheet-none = В этом клипе ничего не анимировано
app-sheet-row = Узел, кривые которого показаны
app-sheet-graph = Каналы, кривые которых показаны
app-sheet-values = { $time }:   { $values }
app-graph-translation = Положение
app-graph-rotation = Поворот, °
app-graph-scale = Масштаб
app-graph-other = Прочие каналы
app-graph-weights = Веса целей морфинга
app-graph-colour = Цвет
app-graph-shininess = Блеск
app-graph-opacity = Непрозрачность

# Дерево сцены
app-tree = Дерево сцены
app-search = Найти узел
app-tree-nothing = Нет открытых файлов.
app-search-nothing = Узлов с таким именем нет.
app-hide-node = Показать или скрыть

# Мышца
app-contraction = Сокращение
app-contraction-tip = Сокращение в процентах; угол в локте меняется вместе с ним
app-elbow = Угол в локте
app-elbow-tip = Угол в локте в градусах; сокращение меняется вместе с ним
app-elbow-clip-tip = Сгибает этот сустав вручную, в градусах – вместо клипа или поверх него
app-joint = Сустав
app-joint-tip = Сустав, который сгибает ползунок
app-joint-found = { $name } (авто)
app-joint-angle = Угол
app-joint-axis = Ось
app-joint-axis-hinge = сгибание
app-joint-on-top = Поверх клипа
app-joint-on-top-tip = Включено: угол прибавляется к движению из клипа. Выключено: угол заменяет движение из клипа.
app-joint-release = Вернуть клипу
app-joint-held-elbow = Угол в локте задан вручную: { $angle }°
app-joint-held = Угол «{ $joint }» задан вручную: { $angle }°
app-joint-release-tip = Вернуть сустав клипу: он снова движется по клипу
app-new-muscle = Новая
app-new-muscle-tip = Добавить мышцу: на руку или на кости, которые сходятся в выбранном суставе либо в локте
app-muscle-menu = Создать копию (в том числе зеркальную), удалить или заменить мышцу
app-do-new-muscle = Добавить мышцу
app-do-duplicate-muscle = Создать копию
app-do-delete-muscle = Удалить
app-do-pick-origin = Указать кость начала
app-do-pick-insertion = Указать кость прикрепления
app-muscle-replace = Заменить на
app-muscle-name = Название
app-fit-length = Сделать текущую длину длиной покоя
app-fit-length-tip = Длина покоя L₀ станет равной текущей длине брюшка
app-ends-heading = Крепления
app-ends-none = нет
app-origin = Начало
app-origin-bone = Кость начала
app-origin-pick = Указать кость начала
app-origin-x = Начало: смещение вдоль оси X кости
app-origin-y = Начало: смещение вдоль оси Y кости
app-origin-z = Начало: смещение вдоль оси Z кости
app-insertion = Прикрепление
app-insertion-bone = Кость прикрепления
app-insertion-pick = Указать кость прикрепления
app-insertion-x = Прикрепление: смещение вдоль оси X кости
app-insertion-y = Прикрепление: смещение вдоль оси Y кости
app-insertion-z = Прикрепление: смещение вдоль оси Z кости
app-via = Промежуточные точки
app-via-unit = Промежуточные точки, { $unit }
app-via-number = Промежуточная точка { $number }
app-via-not-passed = Промежуточная точка { $number }, при этом угле не проходится
app-via-point-short = Точка { $number }
app-via-short = { $number }.
app-via-bone = Кость промежуточной точки { $number }
app-via-pick = Указать положение промежуточной точки { $number }
app-via-delete = Удалить промежуточную точку { $number }
app-via-up = Переместить промежуточную точку { $number } выше, к началу
app-via-down = Переместить промежуточную точку { $number } ниже, к прикреплению
app-via-x = Промежуточная точка { $number }: смещение вдоль оси X кости
app-via-y = Промежуточная точка { $number }: смещение вдоль оси Y кости
app-via-z = Промежуточная точка { $number }: смещение вдоль оси Z кости
app-via-ranged = Только при углах
app-via-ranged-of = Промежуточная точка { $number } проходится, только пока угол в суставе лежит в диапазоне
app-via-from = Наименьший угол, при котором проходится промежуточная точка { $number }, градусы
app-via-to = Наибольший угол, при котором проходится промежуточная точка { $number }, градусы
app-via-joint = Сустав, от угла в котором зависит, проходится ли промежуточная точка { $number }
app-via-moves = Перемещается при движении в суставе { $joint }
app-via-add = Добавить точку
app-via-add-tip = Добавляет точку посередине самого длинного отрезка; её можно перетащить в области просмотра
app-via-pick-new = Указать положение новой промежуточной точки
app-wrap-on = Кость
app-wraps = Поверхности огибания
app-wrap-number = { $number }.
app-wrap-add = Добавить поверхность
app-wrap-add-tip = Добавляет сферу в суставе с той стороны, с которой проходит мышца
app-wrap-pick-new = Указать кость, в сустав которой ставится новая поверхность огибания
app-wrap-delete = Удалить поверхность огибания { $number }
app-wrap-shape = Форма поверхности огибания { $number }
app-wrap-sphere = Сфера
app-wrap-cylinder = Цилиндр
app-wrap-ellipsoid = Эллипсоид
app-wrap-torus = Тор
app-wrap-centre-only = Центр поверхности огибания
app-wrap-radii-short = Радиусы
app-wrap-radius-x = Радиус поверхности огибания { $number } вдоль её оси X
app-wrap-radius-y = Радиус поверхности огибания { $number } вдоль её оси Y
app-wrap-radius-z = Радиус поверхности огибания { $number } вдоль её оси Z
app-wrap-length-short = Длина
app-wrap-length = Длина поверхности огибания { $number } вдоль её оси
app-wrap-tube-short = Трубка
app-wrap-tube = Радиус трубки поверхности огибания { $number }
app-wrap-rotation = Поворот
app-wrap-rotation-x = Поворот поверхности огибания { $number } вокруг X, градусы
app-wrap-rotation-y = Поворот поверхности огибания { $number } вокруг Y, градусы
app-wrap-rotation-z = Поворот поверхности огибания { $number } вокруг Z, градусы
app-wrap-sided = Мышца огибает поверхность { $number } с одной стороны; иначе – кратчайшим путём
app-wrap-range = Действует
app-wrap-range-of = Часть пути, на которой действует поверхность огибания { $number }
app-wrap-at-joint = У сустава
app-wrap-whole = На всём пути
app-wrap-between = Между двумя точками
app-wrap-from = Точка пути, от которой действует поверхность огибания { $number }
app-wrap-to = Точка пути, до которой действует поверхность огибания { $number }
app-wrap-bone = Кость, с которой связана поверхность огибания { $number }; поверхность ставится в сустав этой кости
app-wrap-pick = Указать кость, в сустав которой ставится поверхность огибания { $number }
app-wrap-centre = Центр поверхности огибания { $number }
app-wrap-centre-short = Центр
app-wrap-x = Центр поверхности огибания { $number }: смещение вдоль оси X кости
app-wrap-y = Центр поверхности огибания { $number }: смещение вдоль оси Y кости
app-wrap-z = Центр поверхности огибания { $number }: смещение вдоль оси Z кости
app-wrap-radius = Радиус поверхности огибания { $number }
app-wrap-radius-short = Радиус
app-wrap-side = Сторона
app-wrap-side-x = Сторона, с которой мышца огибает поверхность { $number }: компонента вдоль оси X
app-wrap-side-y = Сторона, с которой мышца огибает поверхность { $number }: компонента вдоль оси Y
app-wrap-side-z = Сторона, с которой мышца огибает поверхность { $number }: компонента вдоль оси Z
app-wrap-flip = Огибать поверхность { $number } с другой стороны
app-skin-heading = Кожа над мышцами
app-skin-fat = Жировой слой
app-skin-fat-tip = Толщина ткани между кожей и мышцами этого файла; мышца, подошедшая ближе, выталкивает кожу. Enter – применить
app-skin-reach = Охват
app-skin-reach-tip = Расстояние от поверхности мышцы, до которого кожа следует за ней; для всех мышц этого файла. Enter – применить
app-skin-elasticity = Упругость, от 0 до 1
app-skin-elasticity-tip = Насколько кожа рядом с выпуклостью тянется за ней: 0 – не тянется, 1 – тянется сильнее всего; для всех мышц этого файла. Enter – применить
app-hint-pick-origin = Щёлкните кость, на которой начинается мышца, – здесь или в дереве · Esc –⁠ отмена
app-hint-pick-insertion = Щёлкните кость, к которой прикрепляется мышца, – здесь или в дереве · Esc –⁠ отмена
app-hint-pick-via = Щёлкните здесь положение промежуточной точки на кости или кость в дереве · Esc –⁠ отмена
app-hint-pick-wrap = Щёлкните кость, сустав которой огибает мышца, – здесь или в дереве · Esc –⁠ отмена
app-which-muscle = Мышца
app-no-muscle = В этой сцене нет мышц. Добавьте мышцу кнопкой «Новая» или откройте файл мышцы (.yaml).
app-length-limited = При этой длине нет радиусов, сохраняющих объём. Длина ограничена допустимым диапазоном.
app-not-attached = Мышца ни к чему не прикреплена. Задайте ниже начало и прикрепление.
app-not-attached-twist = Мышца не прикреплена: сустав «{ $joint }» вращается вокруг оси самой кости, поэтому у этого сустава нет стороны, которую мышца могла бы пересечь. Выберите другую ось сустава и добавьте мышцу снова либо задайте ниже начало и прикрепление.
app-own-arm = Мышцы этого файла – на собственной руке, рядом с клипом.
app-attach = Прикрепить к «{ $joint }» клипа
app-attach-tip = Прикрепить мышцы этого файла к костям, сходящимся в этом суставе, с масштабом по размеру костей. Чтобы выбрать другой сустав, выделите другую кость. «Отменить» вернёт мышцы на их руку.
app-attached = { $count ->
    [one] { $count } мышца прикреплена к «{ $joint }». «Отменить» вернёт её на руку.
    [few] { $count } мышцы прикреплены к «{ $joint }». «Отменить» вернёт их на руку.
   *[other] { $count } мышц прикреплены к «{ $joint }». «Отменить» вернёт их на руку.
}
app-profile = Профиль
app-profile-tip = Мышца сбоку: сейчас (красная) и в покое (пунктир). Потяните за точку, чтобы изменить радиус, с Shift – множитель прироста.
app-profile-legend = красное – сейчас · пунктир – в покое
app-profile-node = узел { $node }: { $now } (в покое { $rest })
app-volume-heading = Длина и объём
app-length = Длина L
app-rest-length = Длина покоя L₀
app-shortening = Изменение длины
app-volume = Объём V
app-rest-volume = Объём покоя V₀
app-volume-error = Ошибка V / V₀ − 1
app-delta = Параметр прироста δ
app-quadratic-heading = Постоянство объёма: A δ² + B δ + C = 0
app-a = A
app-b = B
app-c = C
app-discriminant = B² − 4AC
app-root-taken = Выбранный корень
app-root-other = Другой корень
app-nodes-heading = Узлы
app-node-number = Узел
app-node-rest = Покой, { $unit }
app-node-growth = Прирост
app-node-now = Сейчас, { $unit }
app-moment-arm = Плечо силы
app-largest-radius = Наибольший радиус
app-largest-radius-value = { $radius } (узел { $node })
app-limits = Допустимая длина: от { $short } ({ $short_cause }) до { $long } ({ $long_cause }).
app-limit-discriminant = B² − 4AC обращается в 0
app-limit-radius = радиус узла { $node } обращается в 0
app-limit-shortest = 40 % длины покоя
app-limit-program = предел программы
app-root-larger = Выбран больший корень: он стремится к 0 при L → L₀, так как B ≥ 0.
app-root-smaller = Выбран меньший корень: он стремится к 0 при L → L₀, так как B < 0.
app-root-double = Корни совпадают: длина достигла предела.
app-node-radius = Радиус в покое
app-node-radius-tip = Радиус узла { $number } в покое; Enter – применить
app-node-growth-tip = Множитель прироста узла { $number } относительно других узлов; Enter – применить
app-node-add = Добавить узел
app-node-add-tip = Добавляет узел после выбранного; длина не меняется
app-node-delete = Удалить узел
app-node-delete-number = Удалить узел { $node }
app-node-delete-tip = Удаляет выбранный узел; длина не меняется
app-shape-heading = Длина, сухожилия, волокна, цвет
app-tendon-origin-length = Сухожилие у начала: длина
app-tendon-origin-radius = Сухожилие у начала: радиус
app-tendon-insertion-length = Сухожилие у прикрепления: длина
app-tendon-insertion-radius = Сухожилие у прикрепления: радиус
app-pennation = Угол перистости при длине покоя
app-unit-degree = °
app-muscle-colour = Цвет
app-do-save = Сохранить мышцу
app-do-save-as = Сохранить мышцу как…
app-do-revert = Вернуть сохранённое
app-save-title = Сохранить мышцу
app-saved-without-comments = Сохранено: { $file }. Комментарии файла сохранить не удалось.
app-ask-save = Сохранить изменения мышцы?
app-ask-save-why = Несохранённые изменения будут потеряны.
app-edit-carried = восстановление несохранённых изменений
app-recovery = Программа завершилась раньше, чем были сохранены изменения мышц ({ $what }). Их можно восстановить.
app-recovery-restore = Восстановить
app-recovery-discard = Удалить
app-recovery-unwritten = Автосохранение изменений не удалось: { $reason }
app-ask-which = Файл мышцы изменила другая программа, а в этом окне есть несохранённые изменения.
app-ask-which-why = Оставить свои изменения (по-прежнему несохранёнными) или перезагрузить файл и потерять их?
app-ask-theirs = Перезагрузить файл
app-ask-mine = Оставить мои изменения
app-ask-discard = Не сохранять

# Отображение
app-display-surfaces = Поверхности
app-display-bones = Кости
app-display-space = Пространство
app-display-light = Свет
app-display-drawing = Отрисовка
app-display-presets = Предустановка
app-preset-clean = Без разметки
app-preset-skeleton = Скелет
app-preset-inspection = Разбор
app-preset-print = Для печати
app-grid-cell = Шаг сетки
app-grid-auto = Автоматически
app-background = Фон
app-background-theme = Как у окна
app-background-white = Белый
app-background-grey = Серый
app-background-black = Чёрный
app-line-width = Толщина линий
app-light-yaw = Азимут света, °
app-light-pitch = Свет над горизонтом, °
app-tip-see-through = Кожа, под которой есть мышцы, рисуется прозрачной
app-tip-skin-follows-muscles = Мышцы приподнимают кожу над собой, а объём каждого участка конечности меняется ровно на столько, на сколько меняется объём мышц в нём; для мышц на костях клипа внутри его кожи
app-tip-lines-of-action = Кратчайший путь каждой мышцы между её креплениями, по которому измеряются её длина и плечо силы
app-tip-materials = Цвета, текстуры и блики из файла; выключено – один материал для всего
app-tip-smooth-normals = Освещение по нормалям вершин из файла; выключено – по плоскости каждого треугольника
app-tip-normal-glyphs = Короткий отрезок из каждой вершины вдоль её нормали
app-tip-wireframe = Рёбра всех треугольников
app-tip-bone-axes = Локальные оси X, Y и Z каждой кости
app-tip-xray = Кости рисуются поверх поверхностей, которые их заслоняют
app-tip-weights = Вес выделенной кости в каждой вершине кожи
app-tip-bounding-box = Наименьший параллелепипед со сторонами вдоль осей, содержащий всю сцену
app-tip-anti-aliasing = Четыре отсчёта на пиксель: края без ступенек, но кадр рисуется дольше
app-tip-depth-test = Выключено – треугольники перекрываются в порядке рисования, а не по расстоянию
app-tip-cull-back-faces = Треугольники, обращённые от камеры, не рисуются
app-tip-frame-times = Миллисекунды каждого этапа отрисовки поверх области просмотра
app-tip-onion-skins = Модель за несколько кадров до и после текущего, полупрозрачная
app-tip-bone-path = Кривая, по которой выделенное движется в этом клипе
app-tip-compare-skinning = Линейный скиннинг и скиннинг на дуальных кватернионах в одной сцене
app-tip-shading = Где вычисляется освещение. Плоская – раз на треугольник. По Гуро – в вершинах. По Фонгу – в каждом пикселе.
app-tip-skinning = Линейный скиннинг, как в COLLADA, теряет объём на скрученных суставах; скиннинг на дуальных кватернионах сохраняет его
app-tip-grid-cell = Сторона клетки координатной сетки
app-tip-line-width = Толщина костей, каркаса, координатной сетки и других линий
app-tip-ambient = Фоновый свет: одинаковый со всех сторон
app-shading = Закраска
app-skinning = Скиннинг
app-skinning-linear = Линейный
app-skinning-dual = Дуальные кватернионы
app-onion-skins = Калька (соседние кадры)
app-onion-skins-before = Кадров до
app-onion-skins-after = Кадров после
app-onion-skins-step = Шаг, кадров
app-compare = Сравнение
app-compare-with = С чем сравнить
app-compare-file = Файл…
app-compare-nothing = Ни с чем
app-compare-clip = Клип { $name }
app-compare-skinning = Другой метод скиннинга
app-compare-side-offset = Смещение вбок, м
app-compare-time-offset = Смещение по времени, с
app-compare-nothing-common = Нет суставов с одинаковыми именами
app-compare-joint = Наибольшее расхождение суставов: { $distance } м ({ $name })
app-compare-vertex = Наибольшее расхождение вершин: { $distance } м
app-compare-ahead = { $name }, на { $seconds } с вперёд
app-ambient = Фоновый свет
app-light-default = Свет следует за камерой, слева сверху. Правая кнопка мыши в области просмотра перемещает свет.
app-light-position = Положение, м: x { $x }; y { $y }; z { $z }

# Диагностика
app-diagnostics-none = Проблем не найдено.
app-diagnostics-warnings = { $count ->
    [one] { $count } предупреждение
    [few] { $count } предупреждения
   *[other] { $count } предупреждений
}
app-diagnostics-notes = { $count ->
    [one] { $count } примечание
    [few] { $count } примечания
   *[other] { $count } примечаний
}
app-diagnostics-copy = Скопировать как текст
app-facts-scene = { $format } { $version }, { $axis }, единица { $unit } м
app-facts-muscles = { $count ->
    [one] { $count } мышца
    [few] { $count } мышцы
   *[other] { $count } мышц
}
app-facts-nodes = { $nodes ->
        [one] { $nodes } узел
        [few] { $nodes } узла
       *[other] { $nodes } узлов
    }, { $meshes ->
        [one] { $meshes } полигональная сетка
        [few] { $meshes } полигональные сетки
       *[other] { $meshes } полигональных сеток
    }, { $clips ->
        [one] { $clips } клип
        [few] { $clips } клипа
       *[other] { $clips } клипов
    }

# Измерения
app-page-measure = Измерения
app-measure-none = Измерять нечего: в этой сцене нет мышцы, которая пересекает локтевой сустав.
app-measure-hint = Щелчок или протягивание по графику сгибает локоть до этого угла.
app-measure-hint-joint = Щелчок или протягивание по графику сгибает сустав { $joint } до этого угла.
app-measure-angle = Угол в локте, °
app-measure-angle-of = Угол в суставе { $joint }, °
app-measure-length = Длина, { $unit }
app-measure-arm = Плечо силы, { $unit }
app-measure-radius = Наибольший радиус, { $unit }
app-measure-copy = Копировать CSV
app-measure-save = Сохранить…
app-measure-save-title = Сохранить как .csv, .png или .svg
app-measure-axis = По горизонтальной оси
app-measure-joint = Сустав
app-measure-joint-tip = Сустав, угол которого меняется; остальные остаются в позе покоя
app-measure-axis-angle = угол в суставе
app-measure-axis-time = время клипа
app-measure-time = Время, с
app-measure-hint-time = Щелчок или протягивание по графику переходит к этому времени.
app-measure-section = Наибольшее сечение, { $unit }²
app-measure-error = Ошибка объёма V / V₀ − 1
app-measure-published = Опубликованные плечи силы бицепса

# Экспорт.
app-do-export = Экспорт…
app-export-title = Экспорт
app-export-go = Экспортировать…
app-export-kind = Формат
app-export-picture = Изображение (PNG)
app-export-gif = Анимация (GIF)
app-export-apng = Анимация без потерь (APNG)
app-export-pictures = Нумерованные изображения (PNG)
app-export-mp4 = Видео (MP4, через ffmpeg)
app-export-webm = Видео (WebM, через ffmpeg)
app-export-obj = Поверхность в этой позе с материалами (OBJ)
app-export-ply = Поверхность в этой позе (PLY)
app-export-stl = Поверхность для печати (STL)
app-export-glb = Вся сцена (glTF, .glb)
app-export-gltf = Вся сцена (glTF, .gltf)
app-export-muscles-csv = Измерения мышц (CSV)
app-export-muscles-json = Измерения мышц (JSON)
app-export-joints-csv = Углы суставов по ходу клипа (CSV)
app-export-joints-json = Углы суставов по ходу клипа (JSON)
app-export-joints = Для каждого сустава: сгибание и поворот от позы покоя, по всему клипу
app-export-muscles = Для каждой мышцы: длина, плечо силы, объём, радиусы, по градусам
app-export-muscles-clip = Для каждой мышцы: длина, плечо силы, объём, радиусы, по всему клипу
app-export-losses = Не поддерживается в glTF и будет потеряно:
app-export-muscles-png = Графики мышц (PNG)
app-export-muscles-svg = Графики мышц (SVG)
app-export-joints-png = График углов суставов (PNG)
app-export-joints-svg = График углов суставов (SVG)
app-export-size = Размер, пиксели
app-export-width = Ширина, пиксели
app-export-height = Высота, пиксели
app-export-motion = Движение
app-export-whole = Весь клип или одно сгибание руки
app-export-marks = Клип от метки A до метки B
app-export-elbow = Сгибание в локте
app-export-contraction = Сокращение мышцы
app-export-turntable = Один оборот модели
app-export-range = Диапазон
app-export-from = От
app-export-to = До
app-export-duration = Длительность, с
app-export-fps = Кадров в секунду
app-export-overlays = Кости, сетка и другая разметка, как в области просмотра
app-export-transparent = Без фона
app-export-progress = Ход экспорта
app-export-frames = { NUMBER($count, useGrouping: 0) } { $count ->
        [one] кадр
        [few] кадра
       *[other] кадров
    } по { $width } × { $height } пикселей, { $seconds } с
app-export-one = Одно изображение { $width } × { $height } пикселей
app-export-surface = Поверхность в текущей позе: мировые координаты, метры, ось Y вверх
app-export-scene = Узлы, скины, клипы, материалы; мышцы становятся целями морфинга
app-export-gif-fps = В GIF не больше { $limit } кадров в секунду.
app-ask-replace = «{ $file }» уже есть{ $more ->
        [0] {""}
        [one] , и ещё { NUMBER($more, useGrouping: 0) } файл
        [few] , и ещё { NUMBER($more, useGrouping: 0) } файла
       *[other] , и ещё { NUMBER($more, useGrouping: 0) } файлов
    }. Заменить?
app-ask-replace-why = Окно выбора файла спрашивало о другом имени.
app-replace = Заменить
app-export-broke = Экспорт прерван из-за внутренней ошибки; ничего не записано.
app-export-empty = Диапазон между указанными моментами пуст.
app-export-too-many = В анимации было бы больше { NUMBER($limit, useGrouping: 0) } кадров; выберите меньше кадров в секунду или диапазон короче.
app-export-no-elbow = В этой сцене нет локтя, который можно согнуть.
app-export-no-muscle = В этой сцене нет мышцы, которую можно сократить.
# Инспектор
app-space-tip = Система координат этих чисел
app-space-local = Локальная
app-space-world = Мировая
app-space-bind = Поза привязки
app-space-inverse-bind = Обратная матрица привязки
app-inspect-copy = Скопировать матрицы как текст
app-position = Положение, м
app-rotation = Поворот, °
app-scale = Масштаб
app-transform = Преобразование
app-matrix = Матрица
app-manual-rotation = Повернуть вручную
app-manual-rotation-reset = Сбросить
app-manual-rotation-reset-tip = Сбросить повороты этого сустава, заданные вручную
app-manual-rotation-reset-all = Сбросить все
app-manual-rotation-reset-all-tip = Сбросить повороты всех суставов, заданные вручную
app-dual-quaternions = Дуальные кватернионы
app-dual-quaternions-tip = Скиннинг на дуальных кватернионах вместо матриц: скрученный сустав сохраняет объём
app-rotate-x = Поворот вокруг X, градусы
app-rotate-y = Поворот вокруг Y, градусы
app-rotate-z = Поворот вокруг Z, градусы
app-angle = Угол сустава
app-angle-end = У последнего сустава цепочки нет своего угла. Выберите три кости.
app-angle-choose = Выбрать три кости
app-angle-from = Первая кость
app-angle-corner = Вершина угла
app-angle-to = Третья кость
app-angle-own = Кости выделенного
app-angle-value = { $from } – { $corner } – { $to }: { $angle }
app-angle-across = Время, с
app-angle-up = Угол, °
app-mesh-heading = Полигональная сетка
app-mesh-points = Положений: { $points }, вершин: { $vertices }
app-mesh-triangles = Треугольников: { $triangles }, наборов текстурных координат: { $sets }
app-mesh-skin = Скин: суставов – { $joints }, весов – { $influences }, на вершину не больше { $most }
app-mesh-morph = Целей морфинга: { $targets }
app-material-texture = { $name } · { $image }
app-material-lost = { $name } · { $image } (не найдено)
app-vertex = Из чего складывается положение вершины { $number }
app-vertex-bind = (форма привязки)
app-vertex-sum = Сумма
app-vertex-note = Кость, вес и вес × положение, которое дала бы вершине одна эта кость (x, y, z, м). Сумма – положение вершины.
app-vertex-dual-quaternions = Кость, вес и вес × положение, которое дала бы вершине одна эта кость. Скиннинг на дуальных кватернионах ставит вершину в { $apart } м от этой суммы.
app-vertex-rigid = У этой вершины нет весов скина: она движется со своим узлом.
app-distance = Расстояние между двумя последними точками: { $distance } м
app-distance-one = Щёлкните вторую точку, чтобы измерить расстояние.
app-validation-open = Сравнить с измерениями…
app-validation-tip = Сравнивает радиусы мышцы с измеренными и показывает, почему они расходятся
app-validation = Модель и измерения
app-validation-title = { $muscle } и { $file }
app-validation-about = Модель сохраняет объём. Последняя строка показывает объём, который следует из измеренных радиусов при длине мышцы под каждым углом.
app-validation-radii = Радиусы, { $unit }
app-validation-choose = Измеренные радиусы…
app-validation-fit = Подобрать множители прироста
app-validation-poses = Использовать измеренные позы
app-validation-unread = Не удалось прочитать таблицу

app-do-fit-radii = подбор по измеренным радиусам

app-help-title = Справка
app-help-open = Открыть
app-help-open-text = Откройте клип COLLADA (.dae, .zae) или мышцу (.yaml): { $open } – или перетащите файлы на окно; клип и мышца вместе станут одной сценой. Файл, который записала другая программа, перезагружается автоматически. { $start-page } – примеры и недавние файлы.
app-help-navigate = Навигация
app-help-navigate-text = Мышь вращает камеру, с Shift сдвигает, колесо меняет масштаб, правая кнопка перемещает свет. { $fit } показывает всё целиком; { $view-front }, { $view-right } и { $view-top } – виды вдоль осей; { $fly } – полёт клавишами W A S D, Esc его завершает. С { $tool-move }, { $tool-rotate } и { $tool-scale } мышь перемещает, поворачивает и масштабирует саму модель, { $tool-navigate } возвращает её к камере.
app-help-time = Воспроизведение
app-help-time-text = { $play } – воспроизведение. Щелчок или протягивание по шкале времени переходит к этому времени, { $frame-back } и { $frame-forward } – на кадр назад и вперёд, { $previous-key } и { $next-key } – к соседнему ключевому кадру. { $mark-a } и { $mark-b } ограничивают диапазон. { $sheet } показывает ключевые кадры по костям, { $curves } – кривые анимации; { $timeline-zoom-in } увеличивает масштаб шкалы. С { $follow } камера следует за выделенным.
app-help-inspect = Выделенное
app-help-inspect-text = Щелчок выделяет – в области просмотра и в дереве. Под деревом показаны преобразование выделенного, его полигональная сетка и, после щелчка по скину, кости и веса, из которых складывается положение вершины. { $bones } показывает кости, { $weights } – веса вершин для выделенной кости, { $onion-skins } – кальку: позы за несколько кадров до и после.
app-help-muscle = Мышцы
app-help-muscle-text = Двигайте «Сокращение» или «Угол в локте» на странице «Мышца»: второе следует за первым, потому что объём постоянен. Тяните профиль или вводите радиусы, чтобы изменить мышцу; { $undo } отменяет изменение, { $save } сохраняет. Страница «Измерения» строит графики длины и плеча силы.
app-help-export = Сохранение и экспорт
app-help-export-text = { $picture } сохраняет изображение, { $copy-picture } копирует, { $export } сохраняет анимации, видео, поверхности и таблицы. { $save-session } сохраняет открытые файлы вместе с камерой и отображением.
app-help-trouble = Проблемы
app-help-trouble-text = Страница «Диагностика» перечисляет проблемы файла: строку и то, как программа с ними поступила. Файл, который не открылся, назван в полосе над областью просмотра; открытые ранее файлы остаются. { $shortcuts } – все сочетания клавиш; о командной строке рассказывает sinew --help.
app-do-mirror-muscle = Создать зеркальную копию
app-do-attach-arms = Мышцы рук
app-do-attach-legs = Мышцы ног
app-do-attach-body = Мышцы рук и ног
app-menu-muscles = Мышцы
app-menu-muscle-sets = Прикрепить набор мышц
app-set-attached = { $count ->
    [one] К фигуре прикреплена { $count } мышца. «Отменить» снимет её.
    [few] К фигуре прикреплены { $count } мышцы. «Отменить» снимет их.
   *[other] К фигуре прикреплено { $count } мышц. «Отменить» снимет их.
}
